v.operator&& = 1;   //! E207@11
