Scene = scene(); o = object(); o.n = 0;
for (x in [1, 2, 3]) { o.n += x; o.n++; Scene.Render(); }
print(o.n);   //= 9
