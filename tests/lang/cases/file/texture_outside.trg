t = texture("../a.png");   //! E510@5
