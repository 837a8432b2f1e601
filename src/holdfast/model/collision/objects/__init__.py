"""Objects of a cell against an arm, by the form of their distance."""
