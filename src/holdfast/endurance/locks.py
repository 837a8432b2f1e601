"""What an arm with one locked joint does next on its path: the same pose-following step for many locks at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.paths.timed_path import TimedPath
from holdfast.solvers.curve_tracing import Tracer

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Index = NDArray[np.int64]

_NEWTON = 10
_ON_POSE = 1e-8  # rad, and lengths in units of the arm's own
_JUMP = 0.35  # rad or m of one joint from pose to pose, and in a Newton step: more may be another branch
_FLAT = 1e-7  # of a unit null vector: what a self-motion does not move
_TURNED = 0.3  # least cosine between the null vectors at the two ends of a step
_SMALLER = 8  # steps in place of one that seems to lead off its branch


@dataclass(frozen=True, eq=False)
class Lock:
    """Follows a path with one joint locked, each row its own; with one degree of redundancy no freedom is left.

    A Newton step of the locked arm is the least-norm step of the whole one, moved along the null vector until the locked
    joint does not move: one kernel serves every lock. A branch ends where the Jacobian without the locked column is singular:
    its determinant is, but for a positive factor, the locked joint's entry of the null vector (Cramer's rule), which changes
    its sign there and nowhere else.

    Attributes:
        arm: The arm.
        tracer: Of the arm and task.
        poses: (T, 4, 4) of the path.
        between: (T - 1, K, 4, 4) evenly between each and the next, and the next.
        holds: Whether configurations (N, n) meet what is asked of them beside the path.
    """

    arm: Arm
    tracer: Tracer
    poses: Array
    between: Array
    holds: Callable[[Array], Flags]

    @classmethod
    def along(cls, arm: Arm, tracer: Tracer, path: TimedPath, time: Array, holds: Callable[[Array], Flags]) -> Lock:
        """On a path, at times (T,), s."""
        parts = np.arange(1, _SMALLER + 1) / _SMALLER
        finer = time[:-1, None] + parts * np.diff(time)[:, None]
        return cls(arm, tracer, path.pose(time), path.pose(finer.ravel()).reshape(*finer.shape, 4, 4), holds)

    def step(self, q: Array, joint: Index, t: int | Index) -> tuple[Array, Flags]:
        """From q (N, n) on pose t, one or (N,), with joint (N,) locked to the pose after it: where, and whether it got there.

        Not if the branch ends on the way, or leaves the limits or what else it must meet.
        """
        target = np.broadcast_to(self.poses[np.asarray(t) + 1], (len(q), 4, 4))
        return self._step(q, joint, np.broadcast_to(t, len(q)), target, self.tracer.newton(q, *_split(target)))

    def held(self, q: Array, joint: Index, poses: Array) -> tuple[Array, Flags]:
        """Configurations (N, n) brought to poses (N, 4, 4) near them without joint (N,), and whether that worked."""
        return self._solved(q, joint, poses, self.tracer.newton(q, *_split(poses)))

    def step_all(self, q: Array, t: Index) -> tuple[Array, Flags]:
        """As :meth:`step` of every joint of every q (N, n) on pose t (N,): (N, n, n), the joint locked second, and (N, n)."""
        n = self.arm.n
        target = self.poses[t + 1]
        first = self.tracer.newton(q, *_split(target))
        every, targets, back, miss, null = (np.repeat(x, n, axis=0) for x in (q, target, *first))
        joint = np.tile(np.arange(n), len(q))
        moved, good = self._step(every, joint, np.repeat(t, n), targets, (back, miss, null))
        return moved.reshape(len(q), n, n), good.reshape(len(q), n)

    def _step(self, q: Array, joint: Index, t: Index, target: Array, begun: tuple[Array, Array, Array]) -> tuple[Array, Flags]:
        """The step in one, and where that seems to lead off the branch, in smaller ones."""
        moved, good = self._solved(q, joint, target, begun)
        again = np.flatnonzero(~good & (np.abs(begun[2][np.arange(len(q)), joint]) > _FLAT))
        here = q[again]
        for k in range(_SMALLER):
            if not again.size:
                break
            part = self.between[t[again], k]
            here, on = self._solved(here, joint[again], part, self.tracer.newton(here, *_split(part)))
            again, here = again[on], here[on]
        moved[again], good[again] = here, True
        good &= ((moved >= self.arm.lower) & (moved <= self.arm.upper)).all(axis=1)
        good[good] = self.holds(moved[good])
        return moved, good

    def _solved(self, q: Array, joint: Index, target: Array, begun: tuple[Array, Array, Array]) -> tuple[Array, Flags]:
        """Newton's method from what its first evaluation gave, and whether that stayed on the branch."""
        back, miss, null = begun
        moved, ended = q.copy(), null.copy()
        on = miss <= _ON_POSE
        alive = np.flatnonzero(~on)
        back, now = back[alive], null[alive]
        for _ in range(_NEWTON):
            if not alive.size:
                break
            rows, lock = np.arange(alive.size), joint[alive]
            entry = now[rows, lock]
            change = back - (back[rows, lock] * entry / (entry**2 + _FLAT**2))[:, None] * now
            change[rows, lock] = 0.0
            change *= (_JUMP / np.maximum(np.abs(change).max(axis=1), _JUMP))[:, None]
            moved[alive] += change
            back, miss, now = self.tracer.newton(moved[alive], *_split(target[alive]))
            there = miss <= _ON_POSE
            on[alive[there]] = True
            ended[alive[there]] = now[there]
            # What has run away is another branch, and not worth another evaluation.
            left = ~there & (np.abs(moved[alive] - q[alive]).max(axis=1) <= 3 * _JUMP)
            alive, back, now = alive[left], back[left], now[left]
        rows = np.arange(len(q))
        straight = np.einsum("ij,ij->i", null, ended)
        a, b = null[rows, joint], ended[rows, joint]
        same = (a * b * straight > 0) & (np.abs(straight) >= _TURNED)
        apart = (np.abs(a) <= _FLAT) & (np.abs(b) <= _FLAT)  # the self-motion does not move this joint anywhere
        return moved, np.asarray(on & (same | apart) & (np.abs(moved - q).max(axis=1) <= _JUMP))


def _split(poses: Array) -> tuple[Array, Array]:
    return np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
