"""Read recordings of robots at 10 to 50 frames per second, and examine their episodes for joint faults."""
