"""Reports and figures of lock survival."""
