"""Pages and figures of assessments."""
