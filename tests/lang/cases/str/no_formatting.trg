x = "%s" % 5;   //! E410@5: str % num
