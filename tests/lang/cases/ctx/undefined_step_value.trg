print(i++); print(i);   //? W701@7
//= 0
//= 1
