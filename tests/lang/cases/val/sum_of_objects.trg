x = object() + object();   //! E410@5: object + object
