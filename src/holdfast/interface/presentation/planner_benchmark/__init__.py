"""Reports and figures of planner benchmark suites."""
