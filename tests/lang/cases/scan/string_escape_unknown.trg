m = "BIN\MODELS\cow";   //! E105@9: write \\ or use / //! E105@16
