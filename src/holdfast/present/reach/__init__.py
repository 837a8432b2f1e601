"""Figures of what can be reached."""
