//@ set kind = ball
export kind = "box" ~ choice("box", "ball"); print(kind);   //= ball
