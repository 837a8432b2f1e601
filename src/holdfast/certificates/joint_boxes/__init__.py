"""Claims that are decided by halving boxes of joints: what is out of reach, ceilings."""
