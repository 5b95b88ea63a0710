self = 5; print(self);   //= 5
