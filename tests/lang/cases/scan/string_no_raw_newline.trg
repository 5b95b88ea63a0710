x = "first         //! E104@5: not closed
last";
//! E104@2:5
