f(); f = function() { };   //! E431@1: 'f'
