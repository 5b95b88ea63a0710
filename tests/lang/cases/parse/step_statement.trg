i = 1; i++; ++i; print(i); i--; --i; print(i);
//= 3
//= 1
