switch ("b") { case "a": print(1); break; case "b": print(2); break; }   //= 2
