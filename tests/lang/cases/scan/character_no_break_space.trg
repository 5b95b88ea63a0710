//@ let SPACE = "\u00a0"
x =${SPACE}1;   //! E100@4
