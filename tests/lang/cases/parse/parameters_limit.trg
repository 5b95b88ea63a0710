//@ let PARAMETERS = "p{i}," * 255
f = function(${PARAMETERS}x) { };   //! E223@1181: 255
