x = if;   //! E205@5: keyword
