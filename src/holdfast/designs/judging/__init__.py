"""Arms judged as wholes: what they are worth beside the one configuration that they were made for."""
