"""Reports and figures of studies."""
