s = "abc"; x = s[0];   //! E440@16: str
