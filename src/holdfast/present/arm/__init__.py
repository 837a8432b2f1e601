"""Arms, as people read them."""
