//@ let INCLUDES = "include(\"f{i}.trg\");\n" * 32
//@ files f{i}.trg * 32 = "n{i} = {i};"
${INCLUDES} print(n32);   //= 32
