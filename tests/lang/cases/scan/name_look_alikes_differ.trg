//@ let CYRILLIC = "\u0430"
a = 1; ${CYRILLIC} = 2; print(a);   //? L804@8
//= 1
