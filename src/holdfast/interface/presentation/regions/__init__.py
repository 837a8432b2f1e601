"""Notebook views of regions."""
