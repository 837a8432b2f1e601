"""Faults in simulated recordings of a small arm at 30 frames per second."""
