"""Reports and figures of convergence maps, measures, and comparisons of control laws."""
