from holdfast.response.stowing.path import StowPath as StowPath
from holdfast.response.stowing.pose import StowPose as StowPose
from holdfast.response.stowing.pose import stow as stow
