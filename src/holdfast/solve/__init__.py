"""Which configurations: inverse kinematics, the best configuration of a pose, all of them, and the best along a path."""

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
