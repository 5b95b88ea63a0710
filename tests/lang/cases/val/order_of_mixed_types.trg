x = 1 < "2";   //! E412@5: num < str
