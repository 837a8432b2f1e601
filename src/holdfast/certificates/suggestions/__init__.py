"""Suggestion of claims from samples: working ranges for a box of targets, and a box in a failure-tolerant workspace."""
