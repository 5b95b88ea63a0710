//@ let BRANCHES = "if (x == {i}) print({i}); else " * 149
x = 149; ${BRANCHES} print("none");   //= 149
