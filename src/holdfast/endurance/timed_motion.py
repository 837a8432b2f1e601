"""A motion over the poses of a path between its samples too, with rates and errors; what a lock takes from its velocity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.endurance.injection import healthy
from holdfast.endurance.problem import Problem
from holdfast.indices.determinants import relative_manipulability
from holdfast.motion.events import Curvature
from holdfast.motion.trajectory import Trajectory
from holdfast.solvers.inverse_kinematics import solver

Array = NDArray[np.float64]

_FINER = 5


@dataclass(frozen=True, eq=False, kw_only=True)
class VelocityJump:
    """The twist of the end effector that vanishes when one joint stops at once, ``J_i q_i'``.

    Attributes:
        linear, angular: (T, n) its sizes, m/s and rad/s, for the lock of each joint at each time.
        mean_linear, mean_angular: Means over time and joints, weighted by the failure rates.

    Source: the jump of the end effector's velocity at a lock, Abdi et al., Robotica 30, 2012 (read as an abstract).
    """

    linear: Array
    angular: Array
    mean_linear: float
    mean_angular: float

    @property
    def most_linear(self) -> float:
        """m/s."""
        return float(self.linear.max())

    @property
    def most_angular(self) -> float:
        """rad/s."""
        return float(self.angular.max())


def as_trajectory(problem: Problem, q: Array) -> Trajectory:
    """Of a motion (T, n) over the poses of a problem."""
    arm, task = problem.arm, problem.task
    time = np.linspace(0.0, problem.path.duration, _FINER * (len(q) - 1) + 1)
    joints = healthy(problem, q, time)
    poses = problem.path.pose(time)
    rates = np.gradient(joints, time, axis=0, edge_order=2)
    norm = np.linalg.norm(rates, axis=1)
    position, rotation = solver(arm, task).errors(joints, poses)
    objective = relative_manipulability(arm, task)
    clearance, margin = problem.conditions.room or (None, 0.0)
    whole = np.ones(len(time))
    return Trajectory(
        arm=arm,
        task=task,
        objective=objective,
        method="most locks survived",
        gain=0.0,
        seed=problem.seed,
        rate_cap=None,
        time=time,
        q=joints,
        qd=rates,
        qdd=np.gradient(rates, time, axis=0, edge_order=2),
        poses=poses,
        position_error=position,
        rotation_error=rotation,
        value=np.asarray(objective(joints)),
        curvature=Curvature(objective, task).smallest(joints),
        self_motion=whole,
        task_share=whole,
        damping=0 * whole,
        steps=len(time) - 1,
        peak_rate=float(norm.max()),
        peak_time=float(time[norm.argmax()]),
        events=(),
        clear_of=clearance,
        margin=margin,
    )
