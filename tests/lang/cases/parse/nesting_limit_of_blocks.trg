//@ let OPEN = "{" * 70
//@ let CLOSE = "}" * 70
${OPEN}${CLOSE}   //! E220@65
