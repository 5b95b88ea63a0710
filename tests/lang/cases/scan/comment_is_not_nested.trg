print(1); /* outer /* inner */ print(2);
//= 1
//= 2
