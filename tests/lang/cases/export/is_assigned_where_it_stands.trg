print(isdef(n)); export n = 3; print(n); n = n + 1; print(n);
//= 0
//= 3
//= 4
