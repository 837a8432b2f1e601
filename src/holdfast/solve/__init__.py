"""Which configurations: inverse kinematics, the best configuration of a pose, all of them, and the best along a path."""

from __future__ import annotations

from typing import TYPE_CHECKING

from holdfast.on_demand import offer

if TYPE_CHECKING:
    from holdfast.arm.poses import check_poses
    from holdfast.solve.fibre_path import FibrePath, best_path
    from holdfast.solve.inverse import Reach, solve_ik, solver
    from holdfast.solve.optimise import Optimum, optimise
    from holdfast.solve.self_motion import Component, SelfMotion, fibres, self_motion

__all__ = [
    "Component",
    "FibrePath",
    "Optimum",
    "Reach",
    "SelfMotion",
    "best_path",
    "check_poses",
    "fibres",
    "optimise",
    "self_motion",
    "solve_ik",
    "solver",
]

offer(
    __name__,
    {
        ".arm.poses": "check_poses",
        "fibre_path": "FibrePath best_path",
        "inverse": "Reach solve_ik solver",
        "optimise": "Optimum optimise",
        "self_motion": "Component SelfMotion fibres self_motion",
    },
)
