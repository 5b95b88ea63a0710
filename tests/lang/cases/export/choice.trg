export kind = "box" ~ choice("box", "ball");
//& exports.kind.choices = ("box", "ball")
