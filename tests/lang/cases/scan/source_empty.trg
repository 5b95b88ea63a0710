//@ frames 0
