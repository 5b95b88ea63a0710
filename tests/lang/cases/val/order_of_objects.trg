x = object() > 1;   //! E412@5: object > num
