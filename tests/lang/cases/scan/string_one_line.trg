x = "open          //! E104@5: not closed
