"""Reports of indices at one configuration."""
