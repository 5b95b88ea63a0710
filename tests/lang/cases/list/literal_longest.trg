//@ let ELEMENTS = "{i}, " * 999
l = [${ELEMENTS}1000]; print(len(l), l[999]);   //= 1000 1000
