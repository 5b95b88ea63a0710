x = 5; x = "now a string"; print(x);   //= now a string
