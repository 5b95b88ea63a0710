Scene = scene();
Scene.Add(material::gold());   //! E501@1: Scene.Add expects a shape or a light
