//@ limit max_steps = 5000000
std::limits();
//= steps in a frame: 5000000
//= ...
