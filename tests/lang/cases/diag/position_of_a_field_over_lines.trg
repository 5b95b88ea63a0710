o = object();
x = o                 //! E421@5
  .f;
