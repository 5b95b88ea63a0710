f = mth::sqrt; print(f(9), typeof(f));   //= 3 function
