"""Words of certificates."""
