"""Suggest claims from samples: working ranges for a box of targets, and a box inside a failure-tolerant workspace."""
