"""Where arms come from, as people read it."""
