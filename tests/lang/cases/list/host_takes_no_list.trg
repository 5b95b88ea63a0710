s = sphere([0, 0, 0], 1);   //! E501@5: list
