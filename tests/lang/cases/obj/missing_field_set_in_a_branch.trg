o = object(); if (0) o.f = 1; x = o.f;   //! E421@35
