"""Design search for measures without gradients: an evolution strategy and its objectives."""
