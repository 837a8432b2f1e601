"""Measurements of holdfast that no paper contains: one package for each subject."""
