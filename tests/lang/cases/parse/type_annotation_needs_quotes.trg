f = function(a ~ num) { };   //! E209@18: "num"
