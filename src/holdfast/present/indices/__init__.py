"""What a configuration is worth, as people read it."""
