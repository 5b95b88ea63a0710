f = function(a = 2 ~ "num", b ~ "num" = 1) { };   //! E201@38
