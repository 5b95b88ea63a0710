print(1 == "1", 0 == "", vec3(1) == 1, print == 1, object() == 0);   //= 0 0 0 0 0
