//@ let LOOPS = "while (1) { " * 8
//@ let ENDS = " break; }" * 8
${LOOPS} print(8); ${ENDS}   //= 8
