//@ let ARGUMENTS = "1," * 255
x = f(${ARGUMENTS}1);   //! E223@517: 255
