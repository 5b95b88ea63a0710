//@ limit max_text_bytes = 1048576
s = "0123456789"; for (i = 0; i < 12; i++) s += s;
while (1) { n = object(); n.s = s + i; n.next = last; last = n; i++; }   //! E606@33: 1 MB
