l = [1, 2]; x = l[2];   //! E442@19: 2 elements
