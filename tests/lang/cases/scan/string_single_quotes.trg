x = 'abc';   //! E100@5: double quotes
