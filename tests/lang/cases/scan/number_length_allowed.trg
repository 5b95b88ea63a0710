//@ let DIGITS = "1" * 64
x = ${DIGITS}; print(x > 1e63);   //= 1
