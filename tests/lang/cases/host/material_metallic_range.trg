m = material::gold().Metallic(2);   //! E504@5: 0 .. 1
