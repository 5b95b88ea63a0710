o = object(); x = o.__class__;   //! E421@19
