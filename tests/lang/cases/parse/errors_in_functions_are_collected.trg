f = function() {
    x = ;      //! E205@9
    y = 2;
    z = * 3;   //! E205@9
};
