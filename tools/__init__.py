"""Programs for who works on holdfast; none of them is installed."""
