for (c in "abc") print(c);   //! E444@11: str
