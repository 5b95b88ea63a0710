include "a.trg";   //! E201@8
