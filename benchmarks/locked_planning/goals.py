"""Goal configurations for planners that take configurations, not poses."""

from __future__ import annotations

from typing import Any

import numpy as np
from benchmarks.locked_planning.problems import Problem
from benchmarks.locked_planning.validator import Floats, Json, forward_kinematics

STARTS = 256
ITERATIONS = 60
MAX_GOALS = 8
DAMPING = 1e-4


def find_goal_configurations(robot: Json, problem: Problem, contacts: Any, seed: int = 0) -> Floats:
    """Return up to 8 collision-free configurations (K, 7) of the goal pose with the lock, rad, nearest to the start first.

    A healthy problem has the configuration of the archive. For a lock, damped Newton steps start from 256 random
    configurations. If they find none, this proves nothing.
    """
    if problem.goal is not None:
        return np.array([problem.goal], dtype=float)
    lower, upper = np.asarray(robot["lower"]), np.asarray(robot["upper"])
    free = np.arange(7) != problem.joint
    q: Floats = np.random.default_rng(seed).uniform(lower, upper, (STARTS, 7))
    q[:, ~free] = problem.value
    for _ in range(ITERATIONS):
        error, jacobian = _pose_error(robot, q, problem.goal_pose)
        jacobian[:, :, ~free] = 0.0
        damping = DAMPING * np.minimum(1.0, (error**2).sum(axis=1)) + 1e-12
        square = jacobian @ jacobian.swapaxes(1, 2) + damping[:, None, None] * np.eye(6)
        steps = (jacobian.swapaxes(1, 2) @ np.linalg.solve(square, error[..., None]))[..., 0]
        q = np.clip(q + steps * np.minimum(1.0, 0.5 / np.abs(steps).max(axis=1, keepdims=True).clip(1e-12)), lower, upper)
    q = q[np.abs(_pose_error(robot, q, problem.goal_pose)[0]).max(axis=1) < 1e-6]
    q = q[contacts.distances(q)[0] >= 0] if len(q) else q
    found: list[Floats] = []
    for candidate in q[np.argsort(np.linalg.norm(q - problem.start, axis=1))]:
        if all(np.abs(candidate - other).max() > 1e-3 for other in found):
            found.append(candidate)
    return np.array(found[:MAX_GOALS], dtype=float).reshape(-1, 7)


def _pose_error(robot: Json, q: Floats, goal: Floats) -> tuple[Floats, Floats]:
    """Return the errors (N, 6) of the tool's position, m, and orientation, rad, and the Jacobians (N, 6, 7)."""
    poses, tool = forward_kinematics(robot, q)
    turn = goal[:3, :3] @ tool[:, :3, :3].swapaxes(1, 2)
    axis = np.stack([turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], axis=1) / 2
    sine = np.linalg.norm(axis, axis=1)
    angle = np.arctan2(sine, (np.trace(turn, axis1=1, axis2=2) - 1) / 2)
    rotation = axis * (angle / np.maximum(sine, 1e-12))[:, None]
    axes = poses[:, 1:, :3, 2]
    arms = tool[:, None, :3, 3] - poses[:, 1:, :3, 3]
    jacobian = np.concatenate([np.cross(axes, arms), axes], axis=2).swapaxes(1, 2)
    return np.concatenate([goal[:3, 3] - tool[:, :3, 3], rotation], axis=1), jacobian
