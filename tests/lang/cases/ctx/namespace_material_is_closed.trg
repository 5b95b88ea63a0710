material::mine = 1;   //! E311@1
