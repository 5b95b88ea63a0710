export n = "a" ~ "num";   //! E332@12
