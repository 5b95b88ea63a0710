//@ let CASES = "case {i}:\n" * 1001
switch (0) {
${CASES}
}
//! E226@1003:1: 1000
