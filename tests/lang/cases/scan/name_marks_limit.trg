//@ let ALLOWED = "\u0323" * 30
//@ let MORE = "\u0323" * 31
a${ALLOWED} = 1;
bb${MORE} = 1;   //! E110@3
