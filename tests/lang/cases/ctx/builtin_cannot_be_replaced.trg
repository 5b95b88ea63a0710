sphere = 5;   //! E310@1: 'sphere'
