"""Console text and 3-D views of arms."""
