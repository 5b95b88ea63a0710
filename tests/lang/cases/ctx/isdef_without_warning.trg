print(isdef(u)); u = 1; print(isdef(u));
//= 0
//= 1
