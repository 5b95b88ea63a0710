a = object(); a.b = object(); x = a.b.c.d;   //! E421@35: 'c'
