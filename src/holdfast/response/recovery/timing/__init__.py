"""Timing of a motion: as fast as speeds and accelerations allow, without a stop at every corner."""
