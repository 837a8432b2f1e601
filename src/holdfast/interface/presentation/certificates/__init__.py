"""Reports and figures of certificates."""
