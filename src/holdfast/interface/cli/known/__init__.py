"""Commands for a known failure."""
