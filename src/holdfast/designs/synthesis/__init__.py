"""Arms made from a Jacobian or a null space: lines of joint axes, and the tables of the arms that have them."""
