Scene = scene(); std::setrndmode("quantum"); Scene.Render();   //? W703@18: quantum
//& modes.device = None
