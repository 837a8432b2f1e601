"""Configurations of poses, as people read them."""
