from holdfast.kinematics.holding.static_check import HoldCheck as HoldCheck
from holdfast.kinematics.holding.static_check import holds as holds
