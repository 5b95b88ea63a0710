//@ let INCLUDES = "include(\"f{i}.trg\");\n" * 33
//@ files f{i}.trg * 33
${INCLUDES}
//! E321@35:9: 32
