"""What a motion survives, shown."""
