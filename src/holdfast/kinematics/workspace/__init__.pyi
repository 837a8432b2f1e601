from holdfast.kinematics.workspace import closed_form as closed_form
from holdfast.kinematics.workspace.bounds import joint_bounds as joint_bounds
from holdfast.kinematics.workspace.reachability import ReachabilityMap as ReachabilityMap
from holdfast.kinematics.workspace.reachability import reachability_map as reachability_map
from holdfast.kinematics.workspace.reachable import reachable_when_locked as reachable_when_locked
from holdfast.kinematics.workspace.tolerance import TolerantWorkspace as TolerantWorkspace
from holdfast.kinematics.workspace.tolerance import tolerant_workspace as tolerant_workspace
