"""Read and write files; each failure raises an error with a one-sentence message."""
