print(len("𝄞"), "𝄞");   //= 1 𝄞
