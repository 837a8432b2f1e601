"""Reports of collision models and contacts."""
