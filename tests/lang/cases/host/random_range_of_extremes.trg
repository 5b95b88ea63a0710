least = 1; next = 1.0000000000000002; ok = 1;
for (i = 0; i < 100; i++) { if (mth::rand(least, next) != 1) ok = 0; }
x = mth::rand(-1.7e308, 1.7e308);
print(ok, x - x, mth::rand(5, 5));   //= 1 0 5
