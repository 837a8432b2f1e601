"""Cells as people see them."""
