//@ let LOOPS = "while (1) { " * 6
//@ let ENDS = " break; }" * 6
${LOOPS} f = function() { ${LOOPS} print("in"); ${ENDS} }; f(); ${ENDS}   //= in
