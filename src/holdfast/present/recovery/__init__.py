"""Figures of a recovery."""
