//@ let ONES = "+1" * 250
print(((0${ONES})${ONES})${ONES});   //= 750
