"""Faults in environments of Gymnasium, one or many at once, and their episodes as records."""
