"""Configurations in which everything is kept: how much room is left, straight pieces that are proved, and the way back.

Of each :class:`Kept` two vectors of the tool's pose are looked at: ``v`` across its line or plane, and of the orientation the
part of the tool's axis across its direction (as long as the sine of their angle), or the difference of both rotation matrices
(``2 sqrt(2) sin(angle / 2)`` long). Each must be no longer than a bound. Along a straight piece of joint space, passed through
in time 1, none of them is longer than at the longer end and ``|v''| / 8``, as a straight line between the ends is convex. With
``d`` the joints' motion, ``|v''|`` is at most ``sum_kl r_max(k,l) |d_k| |d_l|`` for the place, ``r_l`` the farthest that the
tool can be from axis l, since ``d2p / dq_k dq_l = z_k x (z_l x r_l)`` for ``k <= l`` (zero for a slide k, and without ``r_l``
for a slide l); and at most ``(sum |d_k|)^2`` for an axis of the tool, ``sqrt(2)`` times that for the matrix.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.poses import rotation_vectors
from holdfast.keep.kept import Kept

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
More = Callable[[Array, NDArray[np.intp]], tuple[Array, Array]]
"""Errors (N, k) and slopes (N, k, n) of what must be met too, for configurations (N, n) and which of those given they are."""

_ROUND = 1e-9  # m and rad
_MET = 1e-8  # m and rad: a row that is kept exactly is met
_INNER = 0.9  # of a cone's opening: what is outside is brought back to there, which leaves room for the next piece
_NEWTON = 12  # steps
_STRIDE = 0.3  # rad or m of one joint in one of them
_HALVED = 8  # times, until a piece that is not proved counts as breaking a row


class Manifold:
    """What is kept, for an arm with locks and limits.

    Args:
        arm: With the limits in force.
        keep: What is kept, through the pose at the start; see :meth:`Kept.anchored`.
        free: (n,) joints that move.
        limits: (n,) and (n,) between which they do; of a locked slide where it is.

    Attributes:
        thin: Some row is kept exactly, so that no straight way through joint space keeps it for long.
    """

    def __init__(self, arm: Arm, keep: Sequence[Kept], free: Flags, limits: tuple[Array, Array]) -> None:
        self.arm, self.keep, self.free = arm, tuple(keep), free
        self._low, self._high = limits
        order, lever = np.arange(arm.n), _levers(arm, *limits)
        self._turns = (~arm.prismatic).astype(np.float64)
        self._lever = lever
        self._second = lever[np.maximum.outer(order, order)] * self._turns[np.minimum.outer(order, order)]
        bounds, exact = [], []
        for kept in self.keep:
            if len(kept.normals):
                bounds.append(kept.within[0])
                exact.append(True)
            if kept.turned:
                bounds.append(2 * np.sqrt(2) * np.sin(kept.widest / 2))
                exact.append(True)
            elif kept.direction is not None:
                bounds.append(np.sin(kept.widest))
                exact.append(kept.angle == 0)
        self._bounds = np.array(bounds)
        self._room = np.where(exact, 1.0, 1 - _INNER) * self._bounds
        self.thin = any(exact)

    # ---- room --------------------------------------------------------------------------------------------------------

    def gaps(self, q: Array) -> Array:
        """(N, R) room left at q (N, n), m and about rad; below 0 where a row is broken."""
        return np.asarray(self._bounds + _ROUND - self._lengths(self.arm.forward_kinematics(q)))

    def holds(self, q: Array) -> Flags:
        """(N,) True where everything is kept at q (N, n)."""
        return np.asarray((self.gaps(q) >= 0).all(axis=1))

    def _lengths(self, poses: Array) -> Array:
        """(N, R) of the vectors that must be no longer than the bounds."""
        found = []
        for kept in self.keep:
            assert kept.pose is not None
            if len(kept.normals):
                found.append(np.linalg.norm((poses[:, :3, 3] - kept.pose[:3, 3]) @ kept.normals.T, axis=1))
            if kept.turned:
                found.append(np.linalg.norm(poses[:, :3, :3] - kept.pose[:3, :3], axis=(1, 2)))
            elif kept.direction is not None:
                axis = poses[:, :3, :3] @ kept.axis
                along = axis @ kept.direction
                sine = np.linalg.norm(axis - along[:, None] * kept.direction, axis=1)
                found.append(np.where(along > 0, sine, 2 - sine))  # beyond 90 deg it is turned away, however small the sine
        return np.stack(found, axis=1)

    def curvature(self, d: Array) -> Array:
        """(N, R) bounds of the second derivatives of the vectors for motions d (N, n)."""
        size = np.abs(d)
        place, turned = ((size @ self._second) * size).sum(axis=1), (size @ self._turns) ** 2
        found = []
        for kept in self.keep:
            if len(kept.normals):
                found.append(place)
            if kept.turned:
                found.append(np.sqrt(2) * turned)
            elif kept.direction is not None:
                found.append(turned)
        return np.stack(found, axis=1)

    def changes(self, d: Array) -> Array:
        """(N, R) bounds of how much the vectors change where joints move by d (N, n)."""
        size, found = np.abs(d), []
        for kept in self.keep:
            if len(kept.normals):
                found.append(size @ self._lever)
            if kept.turned or kept.direction is not None:
                found.append((np.sqrt(2) if kept.turned else 1.0) * (size @ self._turns))
        return np.stack(found, axis=1)

    def edges(self, a: Array, b: Array, away: Array | None = None) -> Flags:
        """(E,) True where everything is proved to be kept on the whole straight piece from a to b (E, n).

        With ``away`` (E, n) also everything whose joints are off it by no more.
        """
        less = 0.0 if away is None else self.changes(away)
        first, last = self.gaps(a) - less, self.gaps(b) - less
        free = np.asarray((first.min(axis=1) >= 0) & (last.min(axis=1) >= 0))
        bend = self.curvature(b - a) / 8
        edge, start = np.flatnonzero(free), np.zeros(int(free.sum()))
        first, last, length = first[edge], last[edge], 1.0
        for _ in range(_HALVED):
            open_ = (np.minimum(first, last) - length**2 * bend[edge] < 0).any(axis=1) & free[edge]
            if not open_.any():
                return free
            edge, start, first, last = edge[open_], start[open_], first[open_], last[open_]
            length /= 2
            gaps = self.gaps(a[edge] + (start + length)[:, None] * (b - a)[edge])
            if away is not None:
                gaps -= self.changes(away[edge])
            free[edge[gaps.min(axis=1) < 0]] = False
            edge, start = np.concatenate([edge, edge]), np.concatenate([start, start + length])
            first, last = np.concatenate([first, gaps]), np.concatenate([gaps, last])
        free[edge] = False
        return free

    def stride(self, d: Array) -> Array:
        """(N,) fractions of motions d (N, n) after which half the room of a kept row may be used up."""
        with np.errstate(divide="ignore"):
            return np.asarray(np.minimum(1.0, np.sqrt(4 * self._room / self.curvature(d)).min(axis=1)))

    # ---- the way back ------------------------------------------------------------------------------------------------

    def projected(self, q: Array, more: More | None = None) -> Array:
        """Configurations near q (N, n) that keep everything within the limits, by Newton's method; maybe not all of them do.

        Args:
            q: (N, n), rad and m; those that keep everything exactly are left as they are.
            more: Errors and slopes of rows that must be met beside those kept; None: there are none.
        """
        q = q.copy()
        moving = np.arange(len(q))
        for _ in range(_NEWTON):
            e, slopes = self._errors(q[moving])
            if more is not None:
                beside = more(q[moving], moving)
                e, slopes = np.concatenate([e, beside[0]], axis=1), np.concatenate([slopes, beside[1]], axis=1)
            off = np.abs(e).max(axis=1) > _MET
            moving, e, slopes = moving[off], e[off], slopes[off]
            if not moving.size:
                break
            q[moving] = self._stepped(q[moving], e, slopes)
        return q

    def _stepped(self, q: Array, e: Array, slopes: Array) -> Array:
        """One step of least length; joints that it pushes over their limits do without."""
        may: Flags = np.broadcast_to(self.free, q.shape)
        for _ in range(2):
            own = slopes * may[:, None, :]
            gram = own @ own.transpose(0, 2, 1)
            gram += (1e-10 * np.trace(gram, axis1=1, axis2=2) + 1e-14)[:, None, None] * np.eye(gram.shape[1])
            step = (own.transpose(0, 2, 1) @ np.linalg.solve(gram, e[:, :, None]))[:, :, 0]
            over = ((q <= self._low) & (step < 0)) | ((q >= self._high) & (step > 0))
            if not (over & may).any():
                break
            may = may & ~over
        step *= np.minimum(1.0, _STRIDE / np.maximum(np.abs(step).max(axis=1), 1e-12))[:, None]
        return np.asarray(np.where(may, np.clip(q + step, self._low, self._high), q))

    def _errors(self, q: Array) -> tuple[Array, Array]:
        """What is missing (N, k) of rows that are kept exactly, and of cones that are left, with the slopes (N, k, n)."""
        poses, jacobian = self.arm.forward_kinematics(q), self.arm.jacobian(q)
        errors, slopes = [], []
        for kept in self.keep:
            assert kept.pose is not None
            if len(kept.normals):
                errors.append((kept.pose[:3, 3] - poses[:, :3, 3]) @ kept.normals.T)
                slopes.append(kept.normals @ jacobian[:, :3])
            if kept.turned:
                errors.append(rotation_vectors(kept.pose[:3, :3] @ poses[:, :3, :3].transpose(0, 2, 1)))
                slopes.append(jacobian[:, 3:])
            elif kept.direction is not None:
                e, turn = _cone(kept, poses[:, :3, :3] @ kept.axis)
                errors.append(e)
                slopes.append(turn @ jacobian[:, 3:])
        return np.concatenate(errors, axis=1), np.concatenate(slopes, axis=1)


def _cone(kept: Kept, axis: Array) -> tuple[Array, Array]:
    """By how much axes (N, 3) must turn, and about what (N, k, 3): to their direction, or if outside back into the cone."""
    assert kept.direction is not None
    across = np.cross(axis, kept.direction)
    sine = np.linalg.norm(across, axis=1)
    angle = np.arctan2(sine, axis @ kept.direction)
    about = np.where(sine[:, None] > 1e-9, across / np.maximum(sine, 1e-12)[:, None], _beside(axis))
    if kept.angle == 0:
        return angle[:, None] * about, np.eye(3) - axis[:, :, None] * axis[:, None, :]
    out = angle > kept.angle - _ROUND
    return np.where(out, angle - _INNER * kept.angle, 0.0)[:, None], np.where(out[:, None], about, 0.0)[:, None, :]


def _beside(axis: Array) -> Array:
    """Unit vectors across axes (N, 3)."""
    other = np.eye(3)[np.abs(axis).argmin(axis=1)]
    across = np.cross(axis, other)
    return np.asarray(across / np.linalg.norm(across, axis=1, keepdims=True))


def _levers(arm: Arm, low: Array, high: Array) -> Array:
    """(n,) how far the tool point can be from each axis, m: the lengths of what lies beyond it; 1 of a slide."""
    length, found = float(np.linalg.norm(arm.tool[:3, 3])), []
    for k, joint in reversed(list(enumerate(arm.joints))):
        if joint.prismatic:
            length += float(max(abs(low[k]), abs(high[k])))
        found.append(1.0 if joint.prismatic else length)
        length += float(np.linalg.norm(joint.origin[:3, 3]))
    return np.array(found[::-1])
