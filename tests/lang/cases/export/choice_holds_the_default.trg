export kind = "cone" ~ choice("box", "ball");   //! E332@15: "box" | "ball"
