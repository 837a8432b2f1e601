"""How far the joints of many designs turn on the self-motion through a configuration, all designs side by side."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import kinematics
from holdfast.caching import cached_property
from holdfast.designs.family import Family
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.linalg import damped_least_norm, householder
from holdfast.solvers.inverse_kinematics import task_error

Array = NDArray[np.float64]

_FAR = 120.0  # rad: longer curves are cut
_CLOSE = 1e-3  # error after one Newton step with which the next one is enough
_STRAIGHT = 0.9  # least cosine between the null vectors at the two ends of a step
_HALVINGS = 6  # of a step before the curve ends there
_ON_CURVE = 0.15  # of a step: how near the curve must come to its first point


@dataclass(frozen=True, kw_only=True)
class Swept:
    """P curves.

    Attributes:
        ranges: (P, n) length of the interval of values of each joint, rad; 2 pi of one that winds, and at most that.
        closed: (P,) the curve came back to its first point.
        winding: (P, n) whole turns on the way round a closed curve.
    """

    ranges: Array
    closed: NDArray[np.bool_]
    winding: NDArray[np.int64]


class Sweeps:
    """The compiled predictor and corrector of all designs of a family, of one degree of redundancy and revolute joints."""

    def __init__(self, family: Family) -> None:
        self.family = family

    @cached_property
    @recalled
    def _pose(self) -> Kernel:
        q = kinematics.joint_symbols(self.family.arm)
        chain = kinematics.chain(self.family.arm, q)
        return Kernel("poses of designs", [q, self.family.x], [ca.vertcat(chain.position, ca.vec(chain.rotation.T))])

    @cached_property
    @recalled
    def _step(self) -> Kernel:
        arm, q = self.family.arm, kinematics.joint_symbols(self.family.arm)
        p, r = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3)
        e, j = task_error(arm, self.family.task, q, p, r)
        scale = ca.sparsify(ca.SX(ca.DM(self.family.task.scale(self.family.space.arm.length_unit))))
        e, j = scale @ e, scale @ j
        null = householder(j).null_rows()
        out = ca.vertcat(q + damped_least_norm(j, e, 1e-14), ca.norm_2(e), *[null[k][0] for k in range(arm.n)])
        return Kernel("self-motion of designs", [q, p, r, self.family.x], [out])

    def __call__(self, values: Array, q: Array, spacing: float) -> Swept:
        """The curves of designs (P, k) through configurations (P, n), rad, in steps of ``spacing``, rad."""
        at = self._pose.rows(q, values)
        p, r = np.ascontiguousarray(at[:, :3]), np.ascontiguousarray(at[:, 3:].reshape(-1, 3, 3))
        lower, upper = self.family.limits(values)
        low, high = q.copy(), q.copy()
        closed, winding = np.zeros(len(q), dtype=bool), np.zeros(q.shape, dtype=np.int64)
        for way in (1.0, -1.0):
            left = np.flatnonzero(~closed & (q >= lower).all(axis=1) & (q <= upper).all(axis=1))
            here, step, gone = q.copy(), np.full(len(q), spacing), np.zeros(len(q))
            along = self._step.rows(q, p, r, values)[:, q.shape[1] + 1 :] * way
            first = along.copy()
            while left.size:
                given = p[left], r[left], values[left]
                start, tangent, size = here[left], along[left], step[left]
                near = self._step.rows(start + size[:, None] * tangent, *given)
                out = self._step.rows(near[:, : q.shape[1]], *given)
                new, ahead = out[:, : q.shape[1]], out[:, q.shape[1] + 1 :]
                turn = np.einsum("ij,ij->i", ahead, tangent)
                moved = np.linalg.norm(new - start, axis=1)
                good = (out[:, q.shape[1]] <= _CLOSE) & (abs(turn) >= _STRAIGHT) & (moved <= 1.5 * size)
                inside = good & ((new >= lower[left]) & (new <= upper[left])).all(axis=1)
                rows = left[inside]
                before, after = start[inside] - q[rows], new[inside] - q[rows]
                here[rows], along[rows] = new[inside], ahead[inside] * np.sign(turn[inside])[:, None]
                gone[rows] += moved[inside]
                home = _home(before, after, first[rows], moved[inside])
                winding[rows[home]] = np.rint(after[home] / (2 * np.pi)).astype(np.int64)
                closed[rows[home]] = True
                np.minimum.at(low, rows[~home], new[inside][~home])
                np.maximum.at(high, rows[~home], new[inside][~home])
                step[rows] = np.minimum(2 * step[rows], spacing)
                step[left[~inside]] *= 0.5
                left = left[~closed[left] & (step[left] >= spacing / 2**_HALVINGS) & (gone[left] <= _FAR)]
        wide = np.minimum(high - low, 2 * np.pi)
        return Swept(ranges=np.where(winding != 0, 2 * np.pi, wide), closed=closed, winding=winding)


def _home(before: Array, after: Array, first: Array, size: Array) -> NDArray[np.bool_]:
    """True where a step passes the first point, which both ends are seen from (modulo whole turns), the way it was left."""
    turns = 2 * np.pi * np.rint(after / (2 * np.pi))
    before, after = before - turns, after - turns
    crosses = (np.einsum("ij,ij->i", before, first) < 0) & (np.einsum("ij,ij->i", after, first) >= 0)
    step = after - before
    part = np.clip(-np.einsum("ij,ij->i", before, step) / np.maximum(np.einsum("ij,ij->i", step, step), 1e-300), 0, 1)
    away = np.linalg.norm(before + part[:, None] * step, axis=1)
    return np.asarray(crosses & (away <= _ON_CURVE * size) & (np.linalg.norm(before, axis=1) <= 2 * size))
