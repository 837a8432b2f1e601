"""Reports of sampled faults."""
