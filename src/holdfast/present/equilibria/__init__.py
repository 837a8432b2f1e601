"""Figures of stationary points and basins."""
