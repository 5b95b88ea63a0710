//@ limit output_lines_frame = 3
for (i = 0; i < 10; i++) print(i);
//= 0
//= 1
//= 2
//= output cut
