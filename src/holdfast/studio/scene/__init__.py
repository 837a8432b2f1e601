"""The arm and what is drawn around it."""
