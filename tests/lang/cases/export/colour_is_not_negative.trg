export c = vec3(-1, 0, 0) ~ "colour";   //! E332@12
