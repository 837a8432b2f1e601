"""Words and figures of suites."""
