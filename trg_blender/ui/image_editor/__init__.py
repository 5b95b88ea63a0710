"""TRG in Blender's image editor: what stands behind a pixel, two renders compared, pictures saved."""
