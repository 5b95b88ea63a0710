//@ let CASES = "case {i}: break; " * 999
switch (0) { ${CASES} case 0: print("last"); }   //= last
