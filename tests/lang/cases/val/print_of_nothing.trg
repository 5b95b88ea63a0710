print(); print("");
//=
//=
