"""Words of configurations that were enclosed."""
