//@ set on = 0
export on = 1 ~ "flag"; print(on);   //= 0
