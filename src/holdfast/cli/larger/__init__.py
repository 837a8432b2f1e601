"""Commands for larger work."""
