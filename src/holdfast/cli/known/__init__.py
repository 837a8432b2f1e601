"""Commands for a failure that one knows of."""
