deep = function() { #deep(); };   //! E607@8: 'deep' are nested too deeply (limit 200)
deep();
