"""Benchmark of motion planners on degraded arms; see ``README.md``."""
