//@ limit max_elements = 1000
l = []; while (1) l.append(0);   //! E612@19: 1000
