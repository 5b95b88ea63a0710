a/**/= 5; print(a);   //= 5
