//@ let DIGITS = "1" * 65
x = ${DIGITS};   //! E103@5: 64
