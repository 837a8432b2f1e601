from holdfast.response.stowing.path import StowPath as StowPath
from holdfast.response.stowing.path import plan_stow_path as plan_stow_path
from holdfast.response.stowing.pose import StowPose as StowPose
from holdfast.response.stowing.pose import stow as stow
