x² = 4; x١ = 5; print(x² + x١);   //= 9
