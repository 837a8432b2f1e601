"""Notebook views of paths."""
