total += 5; print(total);   //= 5
//? W701@1:1
