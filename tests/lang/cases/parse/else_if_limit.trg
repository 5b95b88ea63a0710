//@ let BRANCHES = "if (x == {i}) y = 1; else\n" * 151
x = 1;
${BRANCHES} y = 2;
//! E224@153:1: 150
