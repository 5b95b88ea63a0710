//@ limit max_steps = 30000
//@ let LINE = "x = 1;\n" * 300
f = function() { y = 1;
${LINE} };
for (i = 0; i < 200; i++) f(); print("few");   //= few
