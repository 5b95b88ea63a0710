//@ frames 0
x = 1;
