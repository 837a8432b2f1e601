"""When a motion is where: as fast as speeds and accelerations allow, without a stop at every corner."""
