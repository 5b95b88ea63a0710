f = function() { }; ++f();   //! E206@23
