"""Where it ends: which targets stay within reach, where the failed arm comes to rest, and the way home once it is known."""

from holdfast.converge.bounds import joint_bounds
from holdfast.converge.reachable import reachable_when_locked
from holdfast.converge.recover import recover
from holdfast.converge.recover_goal import RowsGivenUp
from holdfast.converge.recover_left import WhatIsLeft
from holdfast.converge.recover_path import RestOfPath
from holdfast.converge.recover_result import Ending, Leg, Recovery
from holdfast.converge.recover_waypoints import Replay, check_waypoints, read_waypoints, write_waypoints
from holdfast.converge.tolerant_workspace import TolerantWorkspace, tolerant_workspace

__all__ = [
    "Ending",
    "Leg",
    "Recovery",
    "Replay",
    "RestOfPath",
    "RowsGivenUp",
    "TolerantWorkspace",
    "WhatIsLeft",
    "check_waypoints",
    "joint_bounds",
    "reachable_when_locked",
    "read_waypoints",
    "recover",
    "tolerant_workspace",
    "write_waypoints",
]
