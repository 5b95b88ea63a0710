radius = 2; x = raduis * 2;   //! E302@17: radius
