export n = 3 ~ range(0, 10, 2);   //! E332@12
