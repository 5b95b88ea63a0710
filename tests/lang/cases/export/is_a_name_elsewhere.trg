export = 5; print(export);   //= 5
