v = object(); x = -v;   //! E413@19: object
