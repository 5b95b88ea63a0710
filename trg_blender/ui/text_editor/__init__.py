"""TRG in Blender's text editor: colours, mistakes, completion, the project and the log."""
