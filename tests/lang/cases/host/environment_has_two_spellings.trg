print(enviroment(0, 1), environment(0, 1));   //= enviroment(0, 1) enviroment(0, 1)
