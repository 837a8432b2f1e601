"""Reports and figures of assessments."""
