v = object(); x = v + 1;   //! E410@19: object + num
