"""Where arms come from: built in, DH, URDF and MJCF files, results folders."""

from holdfast._lazy import offer

offer(__name__)
