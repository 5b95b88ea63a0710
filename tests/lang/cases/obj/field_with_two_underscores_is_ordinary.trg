o.__dict__ = 5; print(o.__dict__, o);   //= 5 object(__dict__ = 5)
