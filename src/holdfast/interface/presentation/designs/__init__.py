"""Reports and figures of designs."""
