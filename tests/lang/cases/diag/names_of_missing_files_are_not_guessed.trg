include("nowhere.trg");   //! E511@9
print(made_there);
