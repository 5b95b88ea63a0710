print(1 /* print(2) */ + /**/ 2);   //= 3
