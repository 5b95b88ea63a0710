print("before");   //= before
x = 1 / 0;         //! E401@5
print("after");
