"""Commands for a failure that nobody has noticed."""
