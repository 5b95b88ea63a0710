switch (1) { x = 1; }   //! E213@14
