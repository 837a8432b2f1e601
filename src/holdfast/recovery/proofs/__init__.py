"""That what is asked for cannot be done."""
