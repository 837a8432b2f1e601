"""Where it ends: once the failure is known, what is left and the way home."""

from holdfast.converge.recover import recover
from holdfast.converge.recover_goal import RowsGivenUp
from holdfast.converge.recover_left import WhatIsLeft
from holdfast.converge.recover_path import RestOfPath
from holdfast.converge.recover_result import Ending, Leg, Recovery
from holdfast.converge.recover_waypoints import Replay, check_waypoints, read_waypoints, write_waypoints

__all__ = [
    "Ending",
    "Leg",
    "Recovery",
    "Replay",
    "RestOfPath",
    "RowsGivenUp",
    "WhatIsLeft",
    "check_waypoints",
    "read_waypoints",
    "recover",
    "write_waypoints",
]
