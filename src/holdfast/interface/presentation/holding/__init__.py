"""Report of the check whether an arm holds its configuration."""
