export on = 2 ~ "flag";   //! E332@13: 0 | 1
