l = [1]; l.remove(1);   //! E442@19
