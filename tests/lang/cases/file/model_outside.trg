m = model("/a.obj");   //! E510@5
