//@ limit max_text_bytes = 65536
s = "x"; for (i = 0; i < 60000; i++) s += "y";   //! E606@38
