Scene = scene(); Scene.Add(model("BIN\\MODELS\\cow.g3dm", enviroment(0, 1), material::red_plastic())); Scene.Render();
//? W702@1:28: BIN\MODELS\cow.g3dm
//& shapes.0.kind = "model"
