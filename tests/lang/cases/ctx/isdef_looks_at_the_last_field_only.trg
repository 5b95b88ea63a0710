o = object(); x = isdef(o.g.h);   //! E421@25
