//@ let COMPOSED = "\u0439"
//@ let DECOMPOSED = "\u0438\u0306"
${COMPOSED} = 4; print(${DECOMPOSED});   //= 4
