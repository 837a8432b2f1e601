"""Reports and figures of stationary points and basins."""
