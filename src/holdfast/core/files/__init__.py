"""Read and write files; each failure raises an error with one sentence."""
