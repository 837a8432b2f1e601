"""Which configurations: inverse kinematics of batches of poses."""

from holdfast.solve.inverse import Reach, check_poses, solve_ik, solver

__all__ = ["Reach", "check_poses", "solve_ik", "solver"]
