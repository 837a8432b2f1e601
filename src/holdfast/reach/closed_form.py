"""The failure-tolerant workspace of a planar arm of three revolute joints, in closed form for each radius.

Angles here are those of the links in the plane: each joint turns counter-clockwise, and 0 is straight on.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task

Array = NDArray[np.float64]

FULL = 2 * np.pi
_EDGE = 1e-9  # rad: an angle that far beyond a limit rests on it


@dataclass(frozen=True)
class ThreeLinks:
    """A planar arm of three revolute joints without limits.

    Attributes:
        lengths: (3,) m.
        centre: (2,) first joint in the plane of the task, m.
        offset, sign: (3,) link angle of joint k: ``offset[k] + sign[k] q[k]``, rad.
    """

    lengths: Array
    centre: Array
    offset: Array
    sign: Array

    @classmethod
    def of(cls, arm: Arm, task: Task) -> ThreeLinks | None:
        """The arm in the plane of a planar task; None if it is of another kind or a joint cannot turn all the way."""
        if arm.n != 3 or task.name != "planar" or arm.prismatic.any():
            return None
        if not (arm.upper - arm.lower >= FULL - 1e-9).all():
            return None
        flat = arm.frames_at_zero[:, :3, 3] @ task.rows[:, :3].T
        links = np.diff(flat, axis=0)
        lengths = np.linalg.norm(links, axis=1)
        if lengths.min() < 1e-9 * lengths.max():
            return None
        direction = np.arctan2(links[:, 1], links[:, 0])
        normal = np.cross(*task.rows[:, :3])
        return cls(lengths, flat[0], np.diff(direction, prepend=0.0), np.sign(arm.axes_at_zero @ normal))

    def link_limits(self, limits: Array) -> Array:
        """(3, 2) artificial limits of the link angles, from those of the joints (3, 2)."""
        return np.sort(self.offset[:, None] + self.sign[:, None] * limits, axis=1)


def area(arm: ThreeLinks, limits: Array, radii: int) -> Array:
    """Area (P,), m^2, of the failure-tolerant workspace for artificial limits (P, 3, 2) of the link angles.

    ``int r a(r) dr`` over the annulus that locks of joints 2 and 3 leave, with the angular measure a(r) of
    :func:`angles_left`: Gauss-Legendre at ``radii`` nodes in four panels.
    """
    low, high = annulus(arm, limits)
    unit, weight = _nodes(radii)
    width = np.maximum(high - low, 0.0)
    r = low[:, None] + width[:, None] * unit
    measure = np.where(width[:, None] > 0, angles_left(arm, limits, np.maximum(r, 1e-12)), 0.0)
    return np.asarray(width * (weight * r * measure).sum(axis=1))


@cache
def _nodes(radii: int, panels: int = 4) -> tuple[Array, Array]:
    x, w = np.polynomial.legendre.leggauss(max(radii // panels, 2))
    return np.concatenate([(k + (x + 1) / 2) / panels for k in range(panels)]), np.tile(w / 2 / panels, panels)


def annulus(arm: ThreeLinks, limits: Array) -> tuple[Array, Array]:
    """Inner and outer radius (P,) of what the arm reaches wherever joint 2 or joint 3 locks within its limits (P, 3, 2)."""
    second, third = _annulus(arm, limits, 1), _annulus(arm, limits, 2)
    return np.maximum(second[0], third[0]), np.minimum(second[1], third[1])


def _annulus(arm: ThreeLinks, limits: Array, joint: int) -> tuple[Array, Array]:
    """With joint 2 at an angle, links 1 and 2 are one of length ``L = |l1 + l2 e^(i angle)|``, and the arm reaches
    ``|L - l3| <= r <= L + l3``; with joint 3 likewise. ``joint`` counts from 0.
    """
    first, second, third = arm.lengths
    a, b, other = (first, second, third) if joint == 1 else (second, third, first)
    least, most = _cosines(limits[:, joint])
    short, long = (np.sqrt(np.maximum(a * a + b * b + 2 * a * b * c, 0.0)) for c in (least, most))
    return np.maximum(np.abs(short - other), np.abs(long - other)), short + other


def angles_left(arm: ThreeLinks, limits: Array, r: Array) -> Array:
    """Measure (P, R), rad, of the directions of points at radii r (P, R) that are in the region, as far as joint 1 decides.

    A point is there if the healthy arm reaches it within the artificial limits, and the arm with joint 1 locked at any angle
    within its limits does. Both are said by what is left out, arcs of directions; joint 1 has its middle at 0.
    """
    parts = _lost_to_first(arm, limits, r), _out_of_limits(arm, limits, r)
    start, end = (np.concatenate([p[side] for p in parts], axis=-1) for side in (0, 1))
    return np.asarray(FULL - _covered(start, end))


def parts(arm: ThreeLinks, limits: Array, points: Array) -> list[NDArray[np.bool_]]:
    """Of points (N, 2) in the plane of the task, for limits (3, 2) of the link angles: which ones the healthy arm reaches
    within the limits; then, for each joint, which ones it reaches wherever that joint locks. The region is all of them.
    """
    away = points - arm.centre
    r, direction = np.maximum(np.hypot(*away.T), 1e-12), np.arctan2(away[:, 1], away[:, 0])
    turned = (direction - limits[0].mean())[:, None]

    def left(arcs: tuple[Array, Array]) -> NDArray[np.bool_]:
        start, end = arcs[0][0], arcs[1][0]
        return np.asarray(~((end > start) & ((turned - start) % FULL < end - start)).any(axis=1))

    made = [left(_out_of_limits(arm, limits[None], r[None])), left(_lost_to_first(arm, limits[None], r[None]))]
    for joint in (1, 2):
        inner, outer = _annulus(arm, limits[None], joint)
        made.append((r >= inner) & (r <= outer))
    return made


def _lost_to_first(arm: ThreeLinks, limits: Array, r: Array) -> tuple[Array, Array]:
    """Start and end (P, R, 2) of the arcs of directions lost to some lock of joint 1; end < start where there is none.

    With joint 1 locked the other two links reach an annulus about the elbow.
    """
    half = (limits[:, 0, 1] - limits[:, 0, 0])[:, None] / 2
    first, second, third = arm.lengths
    near = (r * r + first**2 - (second - third) ** 2) / (2 * r * first)
    far = (r * r + first**2 - (second + third) ** 2) / (2 * r * first)
    inner, outer = np.arccos(np.clip(near, -1, 1)), np.arccos(np.clip(far, -1, 1))
    everything = np.where((near < -1) | (far > 1), 4 * FULL, 0.0)
    start = np.stack([-inner - half, outer - half], axis=-1) - everything[..., None]
    end = [np.where(inner > 0, inner + half, -4 * FULL), np.where(outer < np.pi, FULL - outer + half, -4 * FULL)]
    return start, np.stack(end, axis=-1) + 2 * everything[..., None]


def _out_of_limits(arm: ThreeLinks, limits: Array, r: Array) -> tuple[Array, Array]:
    """Likewise (P, R, 12) of the directions that the healthy arm does not reach, with joint 1 anywhere within its limits."""
    half = (limits[:, 0, 1] - limits[:, 0, 0])[:, None, None] / 2
    start, end = _directions(arm, limits, r)
    return start + half, end - half


def _directions(arm: ThreeLinks, limits: Array, r: Array) -> tuple[Array, Array]:
    """Arcs (P, R, 12) of directions, measured from link 1, in which the arm does not reach r within limits 2 and 3.

    The directions that it reaches end where joint 1 is critical (joint 3 at 0 or pi) or a joint rests on its limit: twelve
    values, between which one test each decides.
    """
    first, second, third = arm.lengths
    values = []
    for angle in (np.zeros(len(limits)), np.full(len(limits), np.pi), limits[:, 2, 0], limits[:, 2, 1]):
        end = second + third * np.exp(1j * angle)[:, None]
        length, turn = np.abs(end), np.angle(end)
        with np.errstate(divide="ignore", invalid="ignore"):
            bend = np.arccos((r * r - first**2 - length**2) / (2 * first * length))
            aim = np.arccos((r * r + first**2 - length**2) / (2 * r * first))
        ok = _within(np.broadcast_to(angle[:, None], r.shape), limits[:, 2])
        values += [np.where(ok & _within(s * bend - turn, limits[:, 1]), s * aim, np.nan) for s in (1, -1)]
    for angle in (limits[:, 1, 0], limits[:, 1, 1]):
        end = first + second * np.exp(1j * angle)[:, None]
        length, turn = np.abs(end), np.angle(end)
        with np.errstate(divide="ignore", invalid="ignore"):
            bend = np.arccos((r * r - third**2 - length**2) / (2 * third * length))
            aim = np.arccos((r * r + length**2 - third**2) / (2 * r * length))
        values += [np.where(_within(s * bend + turn - angle[:, None], limits[:, 2]), turn + s * aim, np.nan) for s in (1, -1)]
    found = np.sort(np.stack(values, axis=-1) % FULL, axis=-1)  # NaN last
    empty = np.isnan(found[..., :1])
    # Rows without a direction repeat the last one: arcs of length 0. Without any direction all or nothing is reached.
    found = np.where(np.isnan(found), np.nanmax(np.where(empty, 0.0, found), axis=-1, keepdims=True), found)
    start, end = found, np.concatenate([found[..., 1:], found[..., :1] + FULL], axis=-1)
    reached = _reached(arm, limits, r, (start + end) / 2)
    off = reached | (end <= start)
    alone = empty & ~reached[..., -1:]
    # With nothing reached the arc is wider than any dilation fills.
    end = np.where(alone, end + 4 * FULL, end)
    start = np.where(alone, start - 4 * FULL, start)
    return np.where(off, 1.0, start), np.where(off, 0.0, end)


def _reached(arm: ThreeLinks, limits: Array, r: Array, direction: Array) -> NDArray[np.bool_]:
    """Whether the arm with link 1 along 0 reaches (r, direction) (P, R, A) within the limits of joints 2 and 3."""
    first, second, third = arm.lengths
    away = r[..., None] * np.exp(1j * direction) - first
    with np.errstate(invalid="ignore"):
        bend = np.arccos((np.abs(away) ** 2 - second**2 - third**2) / (2 * second * third))
    found = np.zeros(direction.shape, dtype=bool)
    for s in (1, -1):
        elbow = np.angle(away) - np.angle(second + third * np.exp(1j * s * bend))
        found |= _within(s * bend, limits[:, 2]) & _within(elbow, limits[:, 1])
    return found


def _within(angle: Array, limits: Array) -> NDArray[np.bool_]:
    """Whether angles (P, ...) are within limits (P, 2), modulo whole turns; NaN is not."""
    shape = (-1,) + (1,) * (angle.ndim - 1)
    low, high = limits[:, 0].reshape(shape), limits[:, 1].reshape(shape)
    return np.asarray((angle - low + _EDGE) % FULL <= high - low + 2 * _EDGE)


def _cosines(limits: Array) -> tuple[Array, Array]:
    """Least and greatest cosine (P,) over intervals (P, 2)."""
    low, high = limits.T
    ends = np.cos(limits)
    least = np.where((np.pi - low) % FULL <= high - low, -1.0, ends.min(axis=1))
    most = np.where(-low % FULL <= high - low, 1.0, ends.max(axis=1))
    return least, most


def _covered(start: Array, end: Array) -> Array:
    """Length (...,) of the union of arcs (..., A) on the circle; arcs with end <= start are none."""
    length = np.minimum(end - start, FULL)
    none = length <= 0
    begin = np.where(none, 0.0, start % FULL)
    stop = np.where(none, 0.0, begin + length)
    over = np.maximum(stop - FULL, 0.0)
    begins = np.concatenate([begin, np.zeros_like(begin)], axis=-1)
    stops = np.concatenate([np.minimum(stop, FULL), over], axis=-1)
    order = np.argsort(begins, axis=-1)
    begins, stops = np.take_along_axis(begins, order, -1), np.take_along_axis(stops, order, -1)
    reach = np.maximum.accumulate(stops, axis=-1)
    before = np.concatenate([np.zeros_like(reach[..., :1]), reach[..., :-1]], axis=-1)
    return np.asarray(np.maximum(reach - np.maximum(begins, before), 0.0).sum(axis=-1))
