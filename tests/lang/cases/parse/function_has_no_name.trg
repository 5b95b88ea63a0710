function f() { };   //! E201@9: '('
