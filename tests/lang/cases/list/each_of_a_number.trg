for (x in 5) print(x);   //! E444@11: num
