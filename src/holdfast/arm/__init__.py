"""The machine: joints, links, limits, tool, gravity; from DH tables, URDF or MJCF files or built in; symbolic kinematics."""

from holdfast.arm.dh import DH
from holdfast.arm.model import GRAVITY, Arm, Chain, Joint, Link

__all__ = ["DH", "GRAVITY", "Arm", "Chain", "Joint", "Link"]
