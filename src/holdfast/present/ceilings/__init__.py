"""Ceilings, as people read them."""
