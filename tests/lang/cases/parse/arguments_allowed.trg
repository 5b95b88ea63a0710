//@ let ARGUMENTS = "1, " * 254
print(mth::max(${ARGUMENTS}2));   //= 2
