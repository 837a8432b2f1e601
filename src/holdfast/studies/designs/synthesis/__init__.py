"""Make arms from a Jacobian or a null space: the lines of the joint axes, and Denavit-Hartenberg tables with these axes."""
