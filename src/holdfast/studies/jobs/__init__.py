"""Jobs of a study."""
