export a = 1; export b = "x"; export c = vec3(1, 2, 3); export d = -2; export e = vec3(0.5);
//& exports.a.type = "num"
//& exports.b.type = "str"
//& exports.c.type = "vec3"
//& exports.d.default = -2
//& exports.e.default = (0.5, 0.5, 0.5)
