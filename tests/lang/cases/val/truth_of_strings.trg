if ("") print("empty"); if ("0") print("zero"); if (" ") print("space");
//= zero
//= space
