"""Book of record designs, which are the best arms found so far, in files that anyone can check."""
