t = texture("chess.g24", 2); print(t);   //? W702@5: chess.g24
//= texture(chess.g24)
