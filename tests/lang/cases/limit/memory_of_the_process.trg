//@ limit max_bytes = 5242880
//@ let FIELDS = "o.f{i} = 1; " * 300
last = 0;
while (1) { o = object(); ${FIELDS} o.last = last; last = o; }   //! E604@1: 5
