x = [1] + [2];   //! E410@5: list + list
