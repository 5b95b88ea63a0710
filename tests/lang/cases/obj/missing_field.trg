o.radius = 1; x = o.radios;   //! E421@19: radius
