include "a.trg";   //! E201@9
