"""Commands for a first analysis of an arm."""
