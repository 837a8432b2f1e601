"""Motion over the poses of a path also between its samples, with rates and errors, and the velocity that a lock removes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kinematics.indices.determinants import relative_manipulability
from holdfast.kinematics.path_following.events import Curvature
from holdfast.kinematics.path_following.trajectory import Trajectory
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.response.lock_survival.injection import interpolate_motion
from holdfast.response.lock_survival.problem import SurvivalProblem

_SAMPLES_PER_STEP = 5


@dataclass(frozen=True, eq=False, kw_only=True)
class VelocityJump:
    """Twist of the end effector that vanishes when one joint stops at once, ``J_i q_i'``.

    Attributes:
        linear, angular: (T, n) magnitudes, m/s and rad/s, for the lock of each joint at each time.
        mean_linear, mean_angular: Means over time and joints, m/s and rad/s, weighted by the failure rates.

    Source: the jump of the end effector's velocity at a lock, Abdi et al., Robotica 30, 2012 (read as an abstract).
    """

    linear: FloatArray
    angular: FloatArray
    mean_linear: float
    mean_angular: float

    @property
    def most_linear(self) -> float:
        """Largest linear jump, m/s."""
        return float(self.linear.max())

    @property
    def most_angular(self) -> float:
        """Largest angular jump, rad/s."""
        return float(self.angular.max())


def make_trajectory(problem: SurvivalProblem, q: FloatArray) -> Trajectory:
    """Return a motion (T, n) over the poses of a problem as a trajectory."""
    arm, task = problem.arm, problem.task
    times = np.linspace(0.0, problem.path.duration, _SAMPLES_PER_STEP * (len(q) - 1) + 1)
    joints = interpolate_motion(problem, q, times)
    poses = problem.path.pose(times)
    rates = np.gradient(joints, times, axis=0, edge_order=2)
    joint_speeds = np.linalg.norm(rates, axis=1)
    position, rotation = solver(arm, task).position_and_rotation_errors(joints, poses)
    objective = relative_manipulability(arm, task)
    clearance, margin = problem.conditions.required_clearance or (None, 0.0)
    ones = np.ones(len(times))
    return Trajectory(
        arm=arm,
        task=task,
        objective=objective,
        method="most locks survived",
        gain=0.0,
        seed=problem.seed,
        rate_cap=None,
        time=times,
        q=joints,
        qd=rates,
        qdd=np.gradient(rates, times, axis=0, edge_order=2),
        poses=poses,
        position_error=position,
        rotation_error=rotation,
        value=np.asarray(objective(joints)),
        curvature=Curvature(objective, task).smallest(joints),
        self_motion=ones,
        task_share=ones,
        damping=0 * ones,
        steps=len(times) - 1,
        peak_rate=float(joint_speeds.max()),
        peak_time=float(times[joint_speeds.argmax()]),
        events=(),
        clear_of=clearance,
        margin=margin,
    )
