"""Which configurations: inverse kinematics of batches of poses, and the best configuration of a pose."""

from holdfast.arm.poses import check_poses
from holdfast.solve.inverse import Reach, solve_ik, solver
from holdfast.solve.optimise import Optimum, optimise

__all__ = ["Optimum", "Reach", "check_poses", "optimise", "solve_ik", "solver"]
