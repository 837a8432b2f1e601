"""Reports of upper bounds of relative manipulability."""
