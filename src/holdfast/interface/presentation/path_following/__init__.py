"""Reports and figures of a motion along a path."""
