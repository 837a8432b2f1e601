"""Benchmark of planning problems with a locked joint; see ``README.md``."""
