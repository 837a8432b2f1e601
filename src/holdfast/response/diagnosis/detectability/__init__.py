"""Predict which locks a motion will make detectable, and plan motions that isolate them."""
