"""Commands for before a failure."""
