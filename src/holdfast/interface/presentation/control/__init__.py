"""Reports and figures of control laws."""
