//@ limit max_steps = 1000
//@ let LINE = "x = 1;\n" * 300
f = function() { y = 1;
${LINE} };
for (i = 0; i < 3; i++) f(); print("few");   //= few
