include("con");   //! E510@9
