//@ let FIRST = "{i}, " * 100
l = []; for (i = 1; i <= 101; i++) l.append(i);
print(l);
//= [${FIRST}...]
