s = scene(); s.Add = 1;   //! E424@14
