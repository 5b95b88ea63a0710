export n = 1;
export n = 2;   //! E331@8: 'n'
