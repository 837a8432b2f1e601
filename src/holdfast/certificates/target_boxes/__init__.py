"""Boxes of targets, halved until one configuration does for each: pool, search, jobs of it."""
