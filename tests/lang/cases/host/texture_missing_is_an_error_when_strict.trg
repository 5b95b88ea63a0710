//@ option strict_files = true
t = texture("chess.g24");   //! E511@5: chess.g24
