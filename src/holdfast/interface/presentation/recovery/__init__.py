"""Reports and figures of recoveries."""
