include("stl\\rt\\trg_raytrace.trg"); print("ok");   //= ok
