//@ let ELEMENTS = "1," * 1000
l = [${ELEMENTS}1];   //! E227@2006: 1000
