"""The machine: joints, links, limits, tool, gravity; from DH tables, URDF or MJCF files or built in; symbolic kinematics."""

from holdfast._lazy import offer

offer(__name__)
