include("/etc/passwd");   //! E510@9
