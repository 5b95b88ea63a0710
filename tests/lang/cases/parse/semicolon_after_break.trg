while (1) { break }     //! E201@18
