"""Reports and figures of runs with faults."""
