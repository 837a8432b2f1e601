"""Separation of the tool's measured poses under different single locked joints, and visibility of joints to self-motions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import rotation_vectors
from holdfast.model.arm.task import Task, as_task
from holdfast.response.diagnosis.sensors import Sensors

# Log-likelihood ratio between two hypotheses, nats: a wrong one leads by this much once in 10,000 times.
LOG_LIKELIHOOD_THRESHOLD = float(np.log(1e4))
# Number of samples that share one systematic error, and that error in m and rad: poses are independent only over a short time.
_CORRELATED_SAMPLES = 25
_SYSTEMATIC_DEVIATIONS = (0.5e-3, 1e-3)


@check_arguments
def self_motion_rates(arm: Arm, q: ArrayLike, task: str | Task | Sequence[str] = "pose") -> FloatArray:
    """Return the largest rate of each joint over self-motions of unit rate, which limits its visibility to them.

    The rates are the norms of the rows of an orthonormal basis of the null space. Where the task's Jacobian has full rank, they
    equal the relative manipulabilities of the locked joints: **the visibility of a joint in self-motions equals the tolerance
    to its lock**. A joint whose lock is intolerable cannot be tested by a self-motion.

    Args:
        arm: The arm.
        q: (n,) or (N, n) configurations, rad and m.
        task: Task whose value stays constant.

    Returns:
        Rates (n,) or (N, n), between 0 and 1.

    Source: derived here, from relative manipulability (Roberts and Maciejewski 1996).
    """
    required_task = as_task(arm, task)
    checked_q = arm.check_configurations(q)
    _, null = null_space(arm, required_task, np.atleast_2d(checked_q))
    return np.asarray(np.linalg.norm(null, axis=2).reshape(checked_q.shape))


def null_space(arm: Arm, task: Task, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return damped inverses (N, n, m) of the task's Jacobian, in m and rad, and orthonormal bases (N, n, n - m) of its null
    space.
    """
    jacobian = project_to_task(arm, task, q, arm.jacobian(q))
    u, s, vh = np.linalg.svd(jacobian)
    row_count = jacobian.shape[1]
    inverse = np.einsum("bkn,bk,bmk->bnm", vh[:, :row_count], s / (s**2 + 1e-6), u)
    return inverse, vh[:, row_count:].transpose(0, 2, 1)


def project_to_task(arm: Arm, task: Task, q: FloatArray, twists: FloatArray) -> FloatArray:
    """Return the rows of the task (N, m, k) of world twists (N, 6, k) of the tool."""
    if task.frame == "tool":
        world_to_tool = arm.forward_kinematics(q)[:, :3, :3].transpose(0, 2, 1)
        twists = np.concatenate([world_to_tool @ twists[:, :3], world_to_tool @ twists[:, 3:]], axis=1)
    return np.asarray(task.rows @ twists)


def tool_poses_by_hypothesis(arm: Arm, q: FloatArray) -> FloatArray:
    """Return the tool poses (n + 1, K, 4, 4) on a motion (K, n): healthy, then with each joint locked at its first position."""
    motions = np.repeat(q[None], arm.n + 1, axis=0)
    for joint in range(arm.n):
        motions[joint + 1, :, joint] = q[0, joint]
    return arm.forward_kinematics(motions.reshape(-1, arm.n)).reshape(arm.n + 1, len(q), 4, 4)


def pose_differences(poses: FloatArray, reference_poses: FloatArray) -> FloatArray:
    """Return the differences (..., 6) from reference poses to poses: position, m, and rotation vector of ``R_a R_b'``, rad."""
    rotations = rotation_vectors(poses[..., :3, :3] @ np.swapaxes(reference_poses[..., :3, :3], -1, -2))
    return np.concatenate([poses[..., :3, 3] - reference_poses[..., :3, 3], rotations], axis=-1)


def inverse_pose_deviations(sensors: Sensors) -> FloatArray:
    """Return one over the deviation of a sample (6,), its part of the systematic error included."""
    deviations = np.array([sensors.position, sensors.angle])
    return np.repeat(1 / np.hypot(deviations, np.sqrt(_CORRELATED_SAMPLES) * np.array(_SYSTEMATIC_DEVIATIONS)), 3)


def hypothesis_separations(arm: Arm, q: FloatArray, sensors: Sensors) -> FloatArray:
    """Return the separations ``D_ij = 1/2 sum_k |e(X^i_k, X^j_k)|^2``, (n + 1, n + 1), of samples (K, n) of a motion.

    Errors e are in deviations. A test distinguishes i from j with an error of epsilon if D is above ``ln(1/epsilon)`` (Wald).
    """
    poses, weight = tool_poses_by_hypothesis(arm, q), inverse_pose_deviations(sensors)
    separation = np.zeros((arm.n + 1, arm.n + 1))
    for joint in range(arm.n):
        to_later = ((pose_differences(poses[joint + 1 :], poses[joint]) * weight) ** 2).sum(axis=(1, 2)) / 2
        separation[joint, joint + 1 :] = separation[joint + 1 :, joint] = to_later
    return separation


def undetectable_joints(separation: FloatArray, joints: Sequence[int]) -> list[int]:
    """Return the joints whose lock is not distinguishable from a healthy arm."""
    return [joint for joint in joints if not separation[0, joint + 1] > LOG_LIKELIHOOD_THRESHOLD]


def inseparable_pairs(separation: FloatArray, joints: Sequence[int]) -> list[tuple[int, int]]:
    """Return the pairs of joints whose locks are distinguishable from a healthy arm but not from each other."""
    detectable = [first for first in joints if separation[0, first + 1] > LOG_LIKELIHOOD_THRESHOLD]
    return [
        (first, second)
        for index, first in enumerate(detectable)
        for second in detectable[index + 1 :]
        if not separation[first + 1, second + 1] > LOG_LIKELIHOOD_THRESHOLD
    ]
