"""What the user of Blender sees of TRG."""
