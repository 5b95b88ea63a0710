"""Engine room: from scene records to pictures; `bpy` only in the marked files."""
