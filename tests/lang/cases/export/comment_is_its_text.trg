/* How wide the ring is. */
export radius = 3;
//& exports.radius.doc = "How wide the ring is."
