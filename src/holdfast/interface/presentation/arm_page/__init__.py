"""Browser page of an arm."""
