"""Meshes of the objects of a cell."""
