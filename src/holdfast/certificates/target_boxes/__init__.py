"""Boxes of targets, bisected until one configuration proves each cell: pool of configurations, search, and jobs."""
