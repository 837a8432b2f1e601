"""Console text of runs with masses."""
