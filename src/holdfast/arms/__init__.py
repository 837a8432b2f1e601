"""Sources of arms: built-in arms, DH, URDF, and MJCF files, and results folders."""

from holdfast._lazy import offer

offer(__name__)
