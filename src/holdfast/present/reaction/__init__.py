"""What became of an arm with faults, as words, numbers and a page."""
