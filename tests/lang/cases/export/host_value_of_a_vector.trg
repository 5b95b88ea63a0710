//@ set at = 1, 2.5, -3
export at = vec3(0); print(at);   //= vec3(1, 2.5, -3)
