"""Reports and figures of simulations with masses."""
