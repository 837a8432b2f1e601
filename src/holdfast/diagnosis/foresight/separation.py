"""How far apart locks of single joints put the tool's measured pose on a motion, and which joints a self-motion can move."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors
from holdfast.arm.task import Task, as_task
from holdfast.diagnosis.sensors import Sensors

Array = NDArray[np.float64]

LIKELY = float(np.log(1e4))  # one explanation against another: a wrong one leads by so much once in 10,000 times
# Samples that share one systematic error, and that, m and rad: measured poses are not independent for long.
_SHARED, _SYSTEMATIC = 25, (0.5e-3, 1e-3)


@checked
def self_motion_rates(arm: Arm, q: ArrayLike, task: str | Task | Sequence[str] = "pose") -> Array:
    """The largest rate of each joint over self-motions of unit rate: what they can show of it, (n,) or (N, n).

    They are the norms of the rows of an orthonormal basis of the null space, and where the task's Jacobian has full rank they
    are the relative manipulabilities of the locked joints: **a joint is visible to self-motions exactly as far as its lock is
    tolerable**.

    Args:
        arm: The arm.
        q: (n,) or (N, n), rad and m.
        task: What the tool keeps.

    Source: derived here, from relative manipulability (Roberts and Maciejewski 1996).
    """
    rows = as_task(arm, task)
    a = arm.check_configurations(q)
    _, null = null_space(arm, rows, np.atleast_2d(a))
    return np.asarray(np.linalg.norm(null, axis=2).reshape(a.shape))


def null_space(arm: Arm, task: Task, q: Array) -> tuple[Array, Array]:
    """Damped inverses (N, n, m) of the task's Jacobian, in m and rad, and orthonormal bases (N, n, n - m) of its null space."""
    jacobian = task_rows(arm, task, q, arm.jacobian(q))
    u, s, vh = np.linalg.svd(jacobian)
    m = jacobian.shape[1]
    inverse = np.einsum("bkn,bk,bmk->bnm", vh[:, :m], s / (s**2 + 1e-6), u)
    return inverse, vh[:, m:].transpose(0, 2, 1)


def task_rows(arm: Arm, task: Task, q: Array, twists: Array) -> Array:
    """Rows of the task (N, m, k) of world twists (N, 6, k) of the tool."""
    if task.frame == "tool":
        turn = arm.forward_kinematics(q)[:, :3, :3].transpose(0, 2, 1)
        twists = np.concatenate([turn @ twists[:, :3], turn @ twists[:, 3:]], axis=1)
    return np.asarray(task.rows @ twists)


def hypotheses(arm: Arm, q: Array) -> Array:
    """(n + 1, K, 4, 4) tool poses on a motion (K, n): healthy, then with each joint locked where it is at first."""
    motions = np.repeat(q[None], arm.n + 1, axis=0)
    for i in range(arm.n):
        motions[i + 1, :, i] = q[0, i]
    return arm.forward_kinematics(motions.reshape(-1, arm.n)).reshape(arm.n + 1, len(q), 4, 4)


def differences(a: Array, b: Array) -> Array:
    """(..., 6) from poses b to poses a: position, m, and rotation vector of ``R_a R_b'``, rad."""
    turns = rotation_vectors(a[..., :3, :3] @ np.swapaxes(b[..., :3, :3], -1, -2))
    return np.concatenate([a[..., :3, 3] - b[..., :3, 3], turns], axis=-1)


def weights(sensors: Sensors) -> Array:
    """(6,) one over the deviation of a sample, its part of the systematic error included."""
    own = np.array([sensors.position, sensors.angle])
    return np.repeat(1 / np.hypot(own, np.sqrt(_SHARED) * np.array(_SYSTEMATIC)), 3)


def separations(arm: Arm, q: Array, sensors: Sensors) -> Array:
    """(n + 1, n + 1) ``D_ij = 1/2 sum_k |e(X^i_k, X^j_k)|^2`` in deviations, of samples (K, n) of a motion.

    A test tells i from j with an error of epsilon if D is above ``ln(1/epsilon)`` (Wald).
    """
    poses, weight = hypotheses(arm, q), weights(sensors)
    out = np.zeros((arm.n + 1, arm.n + 1))
    for i in range(arm.n):
        apart = ((differences(poses[i + 1 :], poses[i]) * weight) ** 2).sum(axis=(1, 2)) / 2
        out[i, i + 1 :] = out[i + 1 :, i] = apart
    return out


def unseen(separation: Array, joints: Sequence[int]) -> list[int]:
    """Which of the joints' locks cannot be told from none."""
    return [i for i in joints if not separation[0, i + 1] > LIKELY]


def together(separation: Array, joints: Sequence[int]) -> list[tuple[int, int]]:
    """Pairs of the joints whose locks can be told from none, and not from each other."""
    seen = [i for i in joints if separation[0, i + 1] > LIKELY]
    return [(i, j) for k, i in enumerate(seen) for j in seen[k + 1 :] if not separation[i + 1, j + 1] > LIKELY]
