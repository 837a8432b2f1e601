from holdfast.kinematics.regions.region import Region as Region
from holdfast.kinematics.regions.region import builtin_region as builtin_region
from holdfast.kinematics.regions.region import rotation_from_rpy as rotation_from_rpy
from holdfast.kinematics.regions.region import rpy_from_rotation as rpy_from_rotation
