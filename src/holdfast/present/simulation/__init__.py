"""Page and figures of a closed loop."""
