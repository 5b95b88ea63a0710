//@ let LOOPS = "while (1) " * 9
${LOOPS} x = 1;   //! E225@81: 8
