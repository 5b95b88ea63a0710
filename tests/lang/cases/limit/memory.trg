//@ limit max_blocks = 100000
while (1) { n = object(); n.next = last; last = n; }   //! E613@1: 100000
