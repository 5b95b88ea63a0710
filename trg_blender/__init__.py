"""TRG: scenes written as small programs, rendered inside Blender with their error stated."""

__version__ = "0.1.0"
