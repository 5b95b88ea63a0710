//@ newline crlf
y = 1;
x = @;      //! E100@5
