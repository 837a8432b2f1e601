"""Formats of arms: URDF and MJCF files, and the models of MuJoCo and Pinocchio."""
