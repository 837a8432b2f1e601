"""Reports of optimal configurations and self-motions."""
