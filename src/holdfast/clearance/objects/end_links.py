"""Poses of the tool at which no configuration is clear: the pose alone says where the last two links are.

The last link has one place at a pose; the one before it can only do what the last joint lets it. While that joint turns by at
most a from an angle that is looked at, a sphere whose centre is at distance d from its axis goes no farther than d a: if it is
too close to an object by more than that, it is so at all of these angles.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.machine import Joint, Machine
from holdfast.cell.solids import Primitive
from holdfast.clearance.capsules import BASE
from holdfast.clearance.chains import Balls
from holdfast.clearance.object_kernels import FormulaObjects

Array = NDArray[np.float64]

_STAGES = (1, 3, 20)  # angles of the last joint; what they leave open is looked at in the next
_GOLDEN = (np.sqrt(5) - 1) / 2  # its multiples are all round the circle, however few they are
_LAST, _BEFORE = 5, 6  # the joints that move the two links here
_SURE = 1e-5  # m: a configuration meets its pose to a millionth of a metre and a radian, so this much more settles it


class EndLinks:
    """The last two links of an arm as its tool's pose has them, among objects with a formula.

    Args:
        arm: The arm, of two joints or more.
        balls: The spheres that cover it.
        objects: F of them.
        added: (n, F) added to the distance of each link that moves from each, m.
        margins: (F,) what is kept from each, m.
    """

    def __init__(self, arm: Machine, balls: Balls, objects: list[Primitive], added: Array, margins: Array) -> None:
        last, count = arm.joints[-1], sum(_STAGES)
        low, high = (float(x[-1]) for x in finite_limits(arm))
        step = (high - low) / count
        order = np.argsort(np.arange(count) * _GOLDEN % 1)
        self._angles = np.split(low + step * (order + 0.5), np.cumsum(_STAGES)[:-1])
        self._from_tool, back = np.linalg.inv(arm.tool), np.linalg.inv(last.origin)
        some = np.flatnonzero((balls.link >= arm.n - 2) & (balls.link > BASE))[::-1]  # the last link's first
        centre, before = balls.centre[some], balls.link[some] == arm.n - 2
        centre[before] = centre[before] @ back[:3, :3].T + back[:3, 3]  # seen from the last link, and moved the other way
        far = np.ones(len(some)) if last.prismatic else np.linalg.norm(np.cross(centre, last.axis), axis=1)
        radius = balls.radius[some] - before * far * step / 2
        seen = Balls(np.where(before, _BEFORE, _LAST), centre, radius, balls.part[some])
        self._last = np.unique(seen.link) == _LAST
        added = added[np.unique(balls.link[some])[::-1]]
        self._objects, self._margins = FormulaObjects(_end_of(last), seen, objects, added), margins

    def too_close(self, poses: Array, margin: float) -> NDArray[np.bool_]:
        """(N,) True where every configuration of a pose (N, 4, 4), met to 1e-6, is proved to come closer than the margin, m.

        False proves nothing.
        """
        if not (self._last.size and self._margins.size):
            return np.zeros(len(poses), dtype=np.bool_)
        place = _coordinates(poses @ self._from_tool)
        found, left = np.ones(len(poses), dtype=np.bool_), np.arange(len(poses))
        for angles in self._angles:
            q = np.column_stack([np.repeat(place[left], len(angles), axis=0), -np.tile(angles, left.size)])
            room = (self._objects.distances(q) - self._margins).min(axis=2, initial=np.inf)
            close = (room < margin - _SURE).reshape(left.size, len(angles), len(self._last))
            found[left] = still = close.any(axis=2).all(axis=1)
            left = left[still & ~close[:, 0, self._last].any(axis=1)]
        return found


def _end_of(last: Joint) -> Machine:
    """A machine whose first six joints put the last link of an arm anywhere; the seventh is the arm's last, turned round."""
    slides = [Joint(f"along {name}", "prismatic", np.eye(4), axis=axis) for name, axis in zip("xyz", np.eye(3), strict=True)]
    turns = [Joint(f"about {n}", "continuous", np.eye(4), axis=a) for n, a in zip("zyx", np.eye(3)[::-1], strict=True)]
    return Machine("end links", (*slides, *turns, Joint("last", last.type, np.eye(4), axis=last.axis)))


def _coordinates(poses: Array) -> Array:
    """(N, 6) positions, m, and angles about z, then y, then x, rad, of poses (N, 4, 4)."""
    r = poses[:, :3, :3]
    yaw = np.arctan2(r[:, 1, 0], r[:, 0, 0])  # 0 at a quarter turn about y, where any yaw will do
    cosine, sine = np.cos(yaw), np.sin(yaw)
    pitch = np.arctan2(-r[:, 2, 0], cosine * r[:, 0, 0] + sine * r[:, 1, 0])
    roll = np.arctan2(sine * r[:, 0, 2] - cosine * r[:, 1, 2], cosine * r[:, 1, 1] - sine * r[:, 0, 1])
    return np.column_stack([poses[:, :3, 3], yaw, pitch, roll])
