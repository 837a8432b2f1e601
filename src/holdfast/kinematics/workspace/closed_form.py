"""Failure-tolerant workspace of a planar arm with three revolute joints, in closed form for each radius.

Angles here are those of the links in the plane: each joint rotates counter-clockwise, and 0 is straight on.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

FULL_TURN_RAD = 2 * np.pi
_EDGE_TOLERANCE_RAD = 1e-9  # rad: an angle at most this far beyond a limit rests on it


@dataclass(frozen=True)
class ThreeLinks:
    """Planar arm with three revolute joints without limits.

    Attributes:
        lengths: (3,) link lengths, m.
        center: (2,) position of the first joint in the plane of the task, m.
        offset, sign: (3,) constants of the link angle of joint k, ``offset[k] + sign[k] q[k]``, rad.
    """

    lengths: FloatArray
    center: FloatArray
    offset: FloatArray
    sign: FloatArray

    @classmethod
    def from_task(cls, arm: Arm, task: Task) -> ThreeLinks | None:
        """Return ``arm`` in the plane of a planar ``task``; None for another kind, or with limits below a full turn."""
        if arm.n != 3 or task.name != "planar" or arm.prismatic.any():
            return None
        if not (arm.upper - arm.lower >= FULL_TURN_RAD - 1e-9).all():
            return None
        joint_positions = arm.frames_at_zero[:, :3, 3] @ task.rows[:, :3].T
        links = np.diff(joint_positions, axis=0)
        lengths = np.linalg.norm(links, axis=1)
        if lengths.min() < 1e-9 * lengths.max():
            return None
        direction = np.arctan2(links[:, 1], links[:, 0])
        normal = np.cross(*task.rows[:, :3])
        return cls(lengths, joint_positions[0], np.diff(direction, prepend=0.0), np.sign(arm.axes_at_zero @ normal))

    def link_limits(self, limits: FloatArray) -> FloatArray:
        """Return artificial limits (3, 2) of the link angles, rad, from ``limits`` (3, 2) of the joints, rad."""
        return np.sort(self.offset[:, None] + self.sign[:, None] * limits, axis=1)


def workspace_area(arm: ThreeLinks, limits: FloatArray, radii: int) -> FloatArray:
    """Return the area (P,), m^2, of the failure-tolerant workspace of ``arm`` for ``limits`` (P, 3, 2) of the link angles, rad.

    It is ``int r a(r) dr`` over the annulus that remains after locks of joints 2 and 3, with the angular measure a(r) of
    :func:`remaining_angles`, by Gauss-Legendre quadrature at ``radii`` nodes in four panels.
    """
    inner, outer = common_annulus(arm, limits)
    nodes, weight = _quadrature_nodes(radii)
    width = np.maximum(outer - inner, 0.0)
    radii_m = inner[:, None] + width[:, None] * nodes
    angle = np.where(width[:, None] > 0, remaining_angles(arm, limits, np.maximum(radii_m, 1e-12)), 0.0)
    return np.asarray(width * (weight * radii_m * angle).sum(axis=1))


@cache
def _quadrature_nodes(radii: int, panels: int = 4) -> tuple[FloatArray, FloatArray]:
    x, w = np.polynomial.legendre.leggauss(max(radii // panels, 2))
    return np.concatenate([(panel + (x + 1) / 2) / panels for panel in range(panels)]), np.tile(w / 2 / panels, panels)


def common_annulus(arm: ThreeLinks, limits: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the radii (P,), m, that ``arm`` reaches for every lock of joint 2 or 3 within its ``limits`` (P, 3, 2), rad."""
    second_annulus, third_annulus = _locked_annulus(arm, limits, 1), _locked_annulus(arm, limits, 2)
    return np.maximum(second_annulus[0], third_annulus[0]), np.minimum(second_annulus[1], third_annulus[1])


def _locked_annulus(arm: ThreeLinks, limits: FloatArray, joint: int) -> tuple[FloatArray, FloatArray]:
    """Return the annulus with joint 2 locked, ``|L - l3| <= r <= L + l3``, ``L = |l1 + l2 e^(i angle)|``, or joint 3 likewise.

    ``joint`` counts from 0.
    """
    first, second, third = arm.lengths
    a, b, outer_length = (first, second, third) if joint == 1 else (second, third, first)
    min_cosine, max_cosine = _cosine_range(limits[:, joint])
    shortest, longest = (np.sqrt(np.maximum(a * a + b * b + 2 * a * b * cosine, 0.0)) for cosine in (min_cosine, max_cosine))
    return np.maximum(np.abs(shortest - outer_length), np.abs(longest - outer_length)), shortest + outer_length


def remaining_angles(arm: ThreeLinks, limits: FloatArray, r: FloatArray) -> FloatArray:
    """Return the measure of the directions, (P, R) rad, of points at radii ``r`` (P, R), m, that joint 1 leaves in the region.

    A point is in the region if the healthy ``arm`` reaches it within the artificial ``limits`` (P, 3, 2), rad, and so does the
    arm with joint 1 locked at any angle within its limits. Both exclude arcs of directions; joint 1 has its middle at 0.
    """
    arcs = _arcs_lost_to_joint1(arm, limits, r), _arcs_outside_healthy_reach(arm, limits, r)
    start, end = (np.concatenate([pair[side] for pair in arcs], axis=-1) for side in (0, 1))
    return np.asarray(FULL_TURN_RAD - _union_length(start, end))


def classify_points(arm: ThreeLinks, limits: FloatArray, points: FloatArray) -> list[BoolArray]:
    """Return which ``points`` (N, 2), m, in the task plane the healthy ``arm`` reaches within ``limits`` (3, 2), rad, then for
    each joint which points it reaches for every lock of that joint. The region is the intersection of all.
    """
    displacement = points - arm.center
    radius, direction = np.maximum(np.hypot(*displacement.T), 1e-12), np.arctan2(displacement[:, 1], displacement[:, 0])
    relative_angle = (direction - limits[0].mean())[:, None]

    def outside_arcs(arcs: tuple[FloatArray, FloatArray]) -> BoolArray:
        start, end = arcs[0][0], arcs[1][0]
        return np.asarray(~((end > start) & ((relative_angle - start) % FULL_TURN_RAD < end - start)).any(axis=1))

    flags = [
        outside_arcs(_arcs_outside_healthy_reach(arm, limits[None], radius[None])),
        outside_arcs(_arcs_lost_to_joint1(arm, limits[None], radius[None])),
    ]
    for joint in (1, 2):
        inner, outer = _locked_annulus(arm, limits[None], joint)
        flags.append((radius >= inner) & (radius <= outer))
    return flags


def _arcs_lost_to_joint1(arm: ThreeLinks, limits: FloatArray, r: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the start and end (P, R, 2) of the arcs of directions lost to some lock of joint 1; end < start means no arc.

    With joint 1 locked the other two links reach an annulus about the elbow.
    """
    half_range = (limits[:, 0, 1] - limits[:, 0, 0])[:, None] / 2
    first, second, third = arm.lengths
    near_cosine = (r * r + first**2 - (second - third) ** 2) / (2 * r * first)
    far_cosine = (r * r + first**2 - (second + third) ** 2) / (2 * r * first)
    inner, outer = np.arccos(np.clip(near_cosine, -1, 1)), np.arccos(np.clip(far_cosine, -1, 1))
    full_arc = np.where((near_cosine < -1) | (far_cosine > 1), 4 * FULL_TURN_RAD, 0.0)
    start = np.stack([-inner - half_range, outer - half_range], axis=-1) - full_arc[..., None]
    end = [
        np.where(inner > 0, inner + half_range, -4 * FULL_TURN_RAD),
        np.where(outer < np.pi, FULL_TURN_RAD - outer + half_range, -4 * FULL_TURN_RAD),
    ]
    return start, np.stack(end, axis=-1) + 2 * full_arc[..., None]


def _arcs_outside_healthy_reach(arm: ThreeLinks, limits: FloatArray, r: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the ends (P, R, 12) of the arcs of directions that the healthy arm does not reach, with joint 1 in its limits."""
    half_range = (limits[:, 0, 1] - limits[:, 0, 0])[:, None, None] / 2
    start, end = _unreached_directions(arm, limits, r)
    return start + half_range, end - half_range


def _unreached_directions(arm: ThreeLinks, limits: FloatArray, r: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return arcs (P, R, 12) of directions, measured from link 1, in which the arm does not reach r within limits 2 and 3.

    The directions that it reaches end where joint 1 is critical (joint 3 at 0 or pi) or a joint rests on its limit. These are
    twelve values, and one test decides each interval between them.
    """
    first, second, third = arm.lengths
    boundaries = []
    for angle in (np.zeros(len(limits)), np.full(len(limits), np.pi), limits[:, 2, 0], limits[:, 2, 1]):
        end_point = second + third * np.exp(1j * angle)[:, None]
        length, end_angle = np.abs(end_point), np.angle(end_point)
        with np.errstate(divide="ignore", invalid="ignore"):
            elbow_angle = np.arccos((r * r - first**2 - length**2) / (2 * first * length))
            direction = np.arccos((r * r + first**2 - length**2) / (2 * r * first))
        is_valid = _within_limits(np.broadcast_to(angle[:, None], r.shape), limits[:, 2])
        boundaries += [
            np.where(is_valid & _within_limits(sign * elbow_angle - end_angle, limits[:, 1]), sign * direction, np.nan)
            for sign in (1, -1)
        ]
    for angle in (limits[:, 1, 0], limits[:, 1, 1]):
        end_point = first + second * np.exp(1j * angle)[:, None]
        length, end_angle = np.abs(end_point), np.angle(end_point)
        with np.errstate(divide="ignore", invalid="ignore"):
            elbow_angle = np.arccos((r * r - third**2 - length**2) / (2 * third * length))
            direction = np.arccos((r * r + length**2 - third**2) / (2 * r * length))
        boundaries += [
            np.where(
                _within_limits(sign * elbow_angle + end_angle - angle[:, None], limits[:, 2]),
                end_angle + sign * direction,
                np.nan,
            )
            for sign in (1, -1)
        ]
    sorted_angles = np.sort(np.stack(boundaries, axis=-1) % FULL_TURN_RAD, axis=-1)  # NaN is last
    no_boundary = np.isnan(sorted_angles[..., :1])
    # Rows without a direction repeat the last one, as arcs of length 0. Without any direction, all or none is reached.
    sorted_angles = np.where(
        np.isnan(sorted_angles), np.nanmax(np.where(no_boundary, 0.0, sorted_angles), axis=-1, keepdims=True), sorted_angles
    )
    start, end_point = sorted_angles, np.concatenate([sorted_angles[..., 1:], sorted_angles[..., :1] + FULL_TURN_RAD], axis=-1)
    reached = _is_reached(arm, limits, r, (start + end_point) / 2)
    is_excluded = reached | (end_point <= start)
    never_reached = no_boundary & ~reached[..., -1:]
    # If nothing is reached, the arc is wider than any dilation fills.
    end_point = np.where(never_reached, end_point + 4 * FULL_TURN_RAD, end_point)
    start = np.where(never_reached, start - 4 * FULL_TURN_RAD, start)
    return np.where(is_excluded, 1.0, start), np.where(is_excluded, 0.0, end_point)


def _is_reached(arm: ThreeLinks, limits: FloatArray, r: FloatArray, direction: FloatArray) -> BoolArray:
    """Return whether the arm with link 1 along 0 reaches (r, direction) (P, R, A) within the limits of joints 2 and 3."""
    first, second, third = arm.lengths
    displacement = r[..., None] * np.exp(1j * direction) - first
    with np.errstate(invalid="ignore"):
        wrist_angle = np.arccos((np.abs(displacement) ** 2 - second**2 - third**2) / (2 * second * third))
    is_reached = np.zeros(direction.shape, dtype=bool)
    for sign in (1, -1):
        elbow_angle = np.angle(displacement) - np.angle(second + third * np.exp(1j * sign * wrist_angle))
        is_reached |= _within_limits(sign * wrist_angle, limits[:, 2]) & _within_limits(elbow_angle, limits[:, 1])
    return is_reached


def _within_limits(angle: FloatArray, limits: FloatArray) -> BoolArray:
    """Return whether angles (P, ...) are within limits (P, 2), modulo full turns; NaN is not."""
    shape = (-1,) + (1,) * (angle.ndim - 1)
    lower, upper = limits[:, 0].reshape(shape), limits[:, 1].reshape(shape)
    return np.asarray((angle - lower + _EDGE_TOLERANCE_RAD) % FULL_TURN_RAD <= upper - lower + 2 * _EDGE_TOLERANCE_RAD)


def _cosine_range(limits: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the least and greatest cosine (P,) over intervals (P, 2)."""
    lower, upper = limits.T
    end_cosines = np.cos(limits)
    smallest = np.where((np.pi - lower) % FULL_TURN_RAD <= upper - lower, -1.0, end_cosines.min(axis=1))
    largest = np.where(-lower % FULL_TURN_RAD <= upper - lower, 1.0, end_cosines.max(axis=1))
    return smallest, largest


def _union_length(start: FloatArray, end: FloatArray) -> FloatArray:
    """Return the length of the union (...,) of arcs (..., A) on the circle; arcs with end <= start are empty."""
    length = np.minimum(end - start, FULL_TURN_RAD)
    is_empty = length <= 0
    wrapped_start = np.where(is_empty, 0.0, start % FULL_TURN_RAD)
    wrapped_end = np.where(is_empty, 0.0, wrapped_start + length)
    overflow = np.maximum(wrapped_end - FULL_TURN_RAD, 0.0)
    begins = np.concatenate([wrapped_start, np.zeros_like(wrapped_start)], axis=-1)
    stops = np.concatenate([np.minimum(wrapped_end, FULL_TURN_RAD), overflow], axis=-1)
    order = np.argsort(begins, axis=-1)
    begins, stops = np.take_along_axis(begins, order, -1), np.take_along_axis(stops, order, -1)
    furthest = np.maximum.accumulate(stops, axis=-1)
    previous = np.concatenate([np.zeros_like(furthest[..., :1]), furthest[..., :-1]], axis=-1)
    return np.asarray(np.maximum(furthest - np.maximum(begins, previous), 0.0).sum(axis=-1))
