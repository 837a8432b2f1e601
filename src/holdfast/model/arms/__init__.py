"""Sources of arms: built-in arms, DH, URDF, and MJCF files, and results folders."""

from holdfast.core._lazy import offer

offer(__name__)
