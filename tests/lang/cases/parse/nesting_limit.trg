//@ let OPEN = "(" * 100
//@ let CLOSE = ")" * 100
x = ${OPEN}7${CLOSE};   //! E220@67: 64
