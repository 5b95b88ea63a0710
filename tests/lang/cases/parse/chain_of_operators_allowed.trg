//@ let ONES = " + 1" * 400
print(0${ONES});   //= 400
