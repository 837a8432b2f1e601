"""Commands for an undetected failure."""
