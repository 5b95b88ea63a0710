//@ let LONG = "x" * 65536
print(len("${LONG}"));   //= 65536
