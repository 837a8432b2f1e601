"""Book of record designs: the best arms found so far, in files that anyone can check again."""
