"""Exact answers about collisions, of bodies rather than of the spheres that cover them."""
