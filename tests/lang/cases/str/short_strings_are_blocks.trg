//@ limit max_text_bytes = 65536
//@ limit max_blocks = 100000
i = 0; l = []; while (1) { l.append("a short text " + i); i++; }   //! E613@16: 100000
