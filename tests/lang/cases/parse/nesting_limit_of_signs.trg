//@ let MINUS = "- " * 80
x = ${MINUS}1;   //! E220@127
