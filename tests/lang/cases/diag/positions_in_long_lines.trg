//@ let LONG = "/* long */ " * 500
${LONG} x = 1 / 0;   //! E401@5506
