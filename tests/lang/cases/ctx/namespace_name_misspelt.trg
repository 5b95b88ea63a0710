x = material::glod();   //! E302@5: material::gold
