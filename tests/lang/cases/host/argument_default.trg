e = enviroment(0.5); print(e);   //= enviroment(0.5, 1)
