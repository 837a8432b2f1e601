"""Compare arms as wholes, beyond the one configuration for which they were made."""
