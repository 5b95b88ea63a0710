x = typeof();   //! E506@5: typeof(
