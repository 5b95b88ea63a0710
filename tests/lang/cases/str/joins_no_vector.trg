x = "v" + vec3(1);   //! E410@5: str + vec3
