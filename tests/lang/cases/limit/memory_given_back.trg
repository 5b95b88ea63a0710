//@ limit max_blocks = 100000
for (i = 0; i < 200000; i++) { n = object(); n.x = i; } print(n.x);   //= 199999
