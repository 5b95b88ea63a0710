o = object(); print(typeof(o), o);   //= object object()
