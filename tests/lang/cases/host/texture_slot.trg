m = material::gold(); m.SetTexture(texture("a.png"), 6);   //! E504@23
//? W702@1:36
