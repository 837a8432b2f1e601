"""Reports and figures of diagnoses."""
