//@ bom
print(1);   //= 1
