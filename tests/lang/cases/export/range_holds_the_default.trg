export radius = 11 ~ range(0, 10);   //! E332@17: 0 .. 10
