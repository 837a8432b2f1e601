"""Configurations of a pose: words and pictures."""
