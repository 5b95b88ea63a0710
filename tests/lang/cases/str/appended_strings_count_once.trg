//@ limit max_text_bytes = 1048576
s = "0123456789012345678901234567890123456789012345678901234567890123456789"; l = [];
for (i = 0; i < 5000; i++) { s = s + "x"; l.append(s); }   // 12 million characters in all
print(len(l), len(l[0]), len(l[4999]));   //= 5000 71 5070
