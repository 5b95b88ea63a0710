include("");   //! E510@9
