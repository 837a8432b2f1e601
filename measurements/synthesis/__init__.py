"""Arms made from a Jacobian or a null space, and the comparison of all orders of their joint axes; see ``README.md``."""
