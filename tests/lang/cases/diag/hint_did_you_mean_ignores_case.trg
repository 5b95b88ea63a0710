Radius = 1; x = radius;   //! E302@17: Radius
