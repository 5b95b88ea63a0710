s = sphere(1, 2);   //! E501@5: argument 1
