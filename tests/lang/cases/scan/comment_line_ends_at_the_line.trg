// x = @ $ ' ?
print("next");   //= next
