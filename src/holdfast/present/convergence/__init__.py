"""Pages and figures of maps, measures and comparisons of laws."""
