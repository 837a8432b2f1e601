"""Regions, as people read them."""
