"""Files read and written with one sentence when that cannot be done."""
