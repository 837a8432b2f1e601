"""Commands for studies, experiments, benchmarks, and export."""
