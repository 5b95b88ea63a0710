Scene = 1; scene_ = 2; print(Scene + scene_);   //= 3
