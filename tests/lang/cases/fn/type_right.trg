f = function(a ~ "num", b ~ "str", c ~ "vec3", d ~ "object", e ~ "function") { return "ok"; };
print(f(1, "a", vec3(1), object(), f));   //= ok
