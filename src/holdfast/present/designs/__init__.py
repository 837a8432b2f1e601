"""Pages and figures of designs."""
