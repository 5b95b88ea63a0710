include("a.trg"); print(x);   //= 2
//@ bytes a.trg ef bb bf 78 20 3d 20 31 3b 0d 0a 78 2b 2b 3b 0d 0a
