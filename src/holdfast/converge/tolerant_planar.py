"""The failure-tolerant workspace of a planar arm of three revolute joints, in closed form for each radius.

Angles here are those of the links in the plane: each joint turns counter-clockwise, and 0 is straight on.
"""

from __future__ import annotations

from dataclasses import dataclass

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
        """What an arm is in the plane of a planar task; None if it is no such arm or a joint cannot turn all the way."""
        if arm.n != 3 or task.name != "planar" or arm.prismatic.any():
            return None
        if not (arm.upper - arm.lower >= FULL - 1e-9).all():
            return None
        t, places, axes = arm.base, [], []
        for joint in arm.joints:
            t = t @ joint.origin
            places.append(t[:3, 3])
            axes.append(t[:3, :3] @ joint.axis)
        flat = np.array([*places, (t @ arm.tool)[:3, 3]]) @ task.rows[:, :3].T
        links = np.diff(flat, axis=0)
        lengths = np.linalg.norm(links, axis=1)
        if lengths.min() < 1e-9:
            return None
        direction = np.arctan2(links[:, 1], links[:, 0])
        normal = np.cross(*task.rows[:, :3])
        return cls(lengths, flat[0], np.diff(direction, prepend=0.0), np.sign(np.array(axes) @ normal))

    def link_limits(self, limits: Array) -> Array:
        """(3, 2) artificial limits of the link angles, from those of the joints (3, 2)."""
        return np.sort(self.offset[:, None] + self.sign[:, None] * limits, axis=1)

    def joint_limits(self, limits: Array) -> Array:
        """The other way round, each interval moved by whole turns towards 0."""
        made = np.sort(self.sign[:, None] * (limits - self.offset[:, None]), axis=1)
        return np.asarray(made - FULL * np.round(made.mean(axis=1, keepdims=True) / FULL))


def area(arm: ThreeLinks, limits: Array, radii: int) -> tuple[Array, Array]:
    """Area (P,), m^2, of the failure-tolerant workspace for artificial limits (P, 3, 2) of the link angles.

    ``int r a(r) dr`` over the annulus that locks of joints 2 and 3 leave, with the angular measure a(r) of
    :func:`angles_left`; Gauss-Legendre in four panels.

    Returns:
        The area with ``radii`` nodes in all, and the difference to half as many.
    """
    low, high = annulus(arm, limits)
    return _integral(arm, limits, low, high, radii), _integral(arm, limits, low, high, radii // 2)


def _integral(arm: ThreeLinks, limits: Array, low: Array, high: Array, radii: int) -> Array:
    panels = 4
    x, w = np.polynomial.legendre.leggauss(max(radii // panels, 2))
    unit = np.concatenate([(k + (x + 1) / 2) / panels for k in range(panels)])
    weight = np.tile(w / 2 / panels, panels)
    width = np.maximum(high - low, 0.0)
    r = low[:, None] + width[:, None] * unit
    measure = np.where(width[:, None] > 0, angles_left(arm, limits, np.maximum(r, 1e-12)), 0.0)
    return np.asarray(width * (weight * r * measure).sum(axis=1))


def annulus(arm: ThreeLinks, limits: Array) -> tuple[Array, Array]:
    """Inner and outer radius (P,) of what the arm reaches wherever joint 2 or joint 3 locks within its limits (P, 3, 2).

    With joint 2 at an angle, links 1 and 2 are one of length ``L = |l1 + l2 e^(i angle)|``, and the arm reaches
    ``|L - l3| <= r <= L + l3``; with joint 3 likewise.
    """
    first, second, third = arm.lengths
    inner, outer = np.zeros(len(limits)), np.full(len(limits), np.inf)
    for k, (a, b, other) in ((1, (first, second, third)), (2, (second, third, first))):
        least, most = _cosines(limits[:, k])
        short, long = (np.sqrt(np.maximum(a * a + b * b + 2 * a * b * c, 0.0)) for c in (least, most))
        inner = np.maximum(inner, np.maximum(np.abs(short - other), np.abs(long - other)))
        outer = np.minimum(outer, short + other)
    return inner, outer


def angles_left(arm: ThreeLinks, limits: Array, r: Array) -> Array:
    """Measure (P, R), rad, of the directions of points at radii r (P, R) that are in the region, as far as joint 1 decides.

    A point is there if the healthy arm reaches it within the artificial limits, and the arm with joint 1 locked at any angle
    within its limits does. Both are said by what is left out, arcs of directions; joint 1 has its middle at 0.
    """
    width = limits[:, 0, 1] - limits[:, 0, 0]
    start, end = _left_out(arm, limits, r, width)
    return np.asarray(FULL - _covered(start, end))


def _left_out(arm: ThreeLinks, limits: Array, r: Array, width: Array) -> tuple[Array, Array]:
    """Start and end (P, R, A) of the arcs of directions that are not in the region; end < start where there is none."""
    wide = width[:, None]
    # Joint 1 locked: the other two links reach an annulus about the elbow.
    first, second, third = arm.lengths
    with np.errstate(divide="ignore", invalid="ignore"):
        near = (r * r + first**2 - (second - third) ** 2) / (2 * r * first)
        far = (r * r + first**2 - (second + third) ** 2) / (2 * r * first)
    inner, outer = np.arccos(np.clip(near, -1, 1)), np.arccos(np.clip(far, -1, 1))
    none = np.where((near < -1) | (far > 1), 4 * FULL, 0.0)
    starts = [-inner - wide / 2 - none, outer - wide / 2 - none]
    ends = [np.where(inner > 0, inner + wide / 2, -FULL) + none, np.where(outer < np.pi, FULL - outer + wide / 2, -FULL) + none]
    # Healthy: directions that links 2 and 3 within their limits do not give, for no angle of joint 1 within its own.
    low, high = _directions(arm, limits, r)
    starts.extend(np.moveaxis(low + wide[..., None] / 2, -1, 0))
    ends.extend(np.moveaxis(high - wide[..., None] / 2, -1, 0))
    return np.stack(starts, axis=-1), np.stack(ends, axis=-1)


def _directions(arm: ThreeLinks, limits: Array, r: Array) -> tuple[Array, Array]:
    """Arcs (P, R, 13) of directions, measured from link 1, in which the arm does not reach r within limits 2 and 3.

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
    # What is no direction repeats the last one: arcs of length 0. Without any direction all or nothing is reached.
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


def holds(arm: ThreeLinks, limits: Array, points: Array) -> NDArray[np.bool_]:
    """(N,) Whether points (N, 2) in the plane of the task are in the region, for limits (3, 2) of the link angles."""
    away = points - arm.centre
    r, direction = np.hypot(*away.T), np.arctan2(away[:, 1], away[:, 0])
    inner, outer = (float(x[0]) for x in annulus(arm, limits[None]))
    width = limits[None, 0, 1] - limits[None, 0, 0]
    start, end = (x[0] for x in _left_out(arm, limits[None], np.maximum(r, 1e-12)[None], width))
    turned = (direction - limits[0].mean())[:, None]
    out = ((end > start) & ((turned - start) % FULL < end - start)).any(axis=1)
    return np.asarray((r >= inner) & (r <= outer) & ~out)
