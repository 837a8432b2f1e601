"""Reports of enclosed configurations."""
