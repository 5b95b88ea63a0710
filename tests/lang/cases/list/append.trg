l = [1]; l.append(2); l.append("c").append(4); print(l);   //= [1, 2, "c", 4]
