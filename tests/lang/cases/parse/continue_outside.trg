continue;   //! E217@1
