"""Exact collision queries for the bodies themselves instead of the spheres that cover them."""
