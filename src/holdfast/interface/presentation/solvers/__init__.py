"""Reports of configurations of poses."""
