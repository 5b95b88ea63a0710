near = function(x, y) { return mth::abs(x - y) < 1e-12; };
print(mth::noise(0), near(mth::noise(vec3(1, 2, 3)), 0.11277601241897228));              //= -1 1
print(near(mth::noise(0.25), -0.9738209324425935), near(mth::noise(-1), -0.3460298472424107));   //= 1 1
