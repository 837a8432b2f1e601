"""Where it ends: what stays within reach, where a failed arm comes to rest and from where, and the way home afterwards."""

from __future__ import annotations

from typing import TYPE_CHECKING

from holdfast.on_demand import offer

if TYPE_CHECKING:
    from holdfast.converge.basins import Basins, basins
    from holdfast.converge.best_law import LawChoice, best_law
    from holdfast.converge.bounds import joint_bounds
    from holdfast.converge.convergence_map import ConvergenceMap, convergence_map
    from holdfast.converge.curves import Curve, Curves, Segment
    from holdfast.converge.linearisation import Kind, Linearisation, linearisation
    from holdfast.converge.measures import Measures
    from holdfast.converge.orbits import Orbit, orbit
    from holdfast.converge.reachable import reachable_when_locked
    from holdfast.converge.recover import recover
    from holdfast.converge.recover_goal import RowsGivenUp
    from holdfast.converge.recover_left import WhatIsLeft
    from holdfast.converge.recover_path import RestOfPath
    from holdfast.converge.recover_result import Ending, Leg, Recovery
    from holdfast.converge.recover_waypoints import Replay, check_waypoints, read_waypoints, write_waypoints
    from holdfast.converge.starts import Places
    from holdfast.converge.stationary import RestPoints, stationary
    from holdfast.converge.target_measures import TargetMeasures, target_measures
    from holdfast.converge.theorem import column_residual, is_stuck, null_components, stuck_subspace
    from holdfast.converge.tolerant_workspace import TolerantWorkspace, tolerant_workspace
    from holdfast.converge.workspace import Workspace, workspace

__all__ = [
    "Basins",
    "ConvergenceMap",
    "Curve",
    "Curves",
    "Ending",
    "Kind",
    "LawChoice",
    "Leg",
    "Linearisation",
    "Measures",
    "Orbit",
    "Places",
    "Recovery",
    "Replay",
    "RestOfPath",
    "RestPoints",
    "RowsGivenUp",
    "Segment",
    "TargetMeasures",
    "TolerantWorkspace",
    "WhatIsLeft",
    "Workspace",
    "basins",
    "best_law",
    "check_waypoints",
    "column_residual",
    "convergence_map",
    "is_stuck",
    "joint_bounds",
    "linearisation",
    "null_components",
    "orbit",
    "reachable_when_locked",
    "read_waypoints",
    "recover",
    "stationary",
    "stuck_subspace",
    "target_measures",
    "tolerant_workspace",
    "workspace",
    "write_waypoints",
]

offer(
    __name__,
    {
        "basins": "Basins basins",
        "best_law": "LawChoice best_law",
        "bounds": "joint_bounds",
        "convergence_map": "ConvergenceMap convergence_map",
        "curves": "Curve Curves Segment",
        "linearisation": "Kind Linearisation linearisation",
        "measures": "Measures",
        "orbits": "Orbit orbit",
        "reachable": "reachable_when_locked",
        "recover": "recover",
        "recover_goal": "RowsGivenUp",
        "recover_left": "WhatIsLeft",
        "recover_path": "RestOfPath",
        "recover_result": "Ending Leg Recovery",
        "recover_waypoints": "Replay check_waypoints read_waypoints write_waypoints",
        "starts": "Places",
        "stationary": "RestPoints stationary",
        "target_measures": "TargetMeasures target_measures",
        "theorem": "column_residual is_stuck null_components stuck_subspace",
        "tolerant_workspace": "TolerantWorkspace tolerant_workspace",
        "workspace": "Workspace workspace",
    },
)
