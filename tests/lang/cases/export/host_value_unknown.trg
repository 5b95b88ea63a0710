//@ set raduis = 4
//! E520@1:1: radius
export radius = 3;
