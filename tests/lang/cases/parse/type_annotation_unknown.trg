f = function(a ~ "nunber") { };   //! E304@18: num
