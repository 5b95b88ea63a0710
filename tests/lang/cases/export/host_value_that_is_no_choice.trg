//@ set kind = cone
export kind = "box" ~ choice("box", "ball");   //! E521@8
