f = function(case) { };   //! E204@14: 'case'
