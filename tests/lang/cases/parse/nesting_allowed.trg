//@ let OPEN = "(" * 60
//@ let CLOSE = ")" * 60
print(${OPEN}7${CLOSE});   //= 7
