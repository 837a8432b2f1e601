"""Faults in environments of Gymnasium, one or many at once, and their recorded episodes."""
