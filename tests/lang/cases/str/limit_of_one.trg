//@ limit max_string = 100
s = "0123456789";
while (1) s += s;   //! E605@11: 100
