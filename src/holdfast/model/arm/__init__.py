"""Model of a serial arm: joints, links, limits, tool, and gravity, with symbolic kinematics, statics, and dynamics.

Arms come from DH tables, URDF or MJCF files, or are built in.
"""

from holdfast.core._lazy import offer

offer(__name__)
