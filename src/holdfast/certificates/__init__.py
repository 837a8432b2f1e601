"""Claims about every target and every locked angle, proved by files that anybody can check."""
