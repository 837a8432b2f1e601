"""Distance between two line segments as straight-line code, valid for parallel and touching segments and for points."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from holdfast.kernels.program import SX

_PARALLEL_TOLERANCE = 1e-15  # of sin^2 of the angle: the rounding of the determinant; below it any first point is valid
_MIN_SQUARE_DISTANCE = 1e-24  # m^2: keeps the root of the squared distance differentiable where the axes intersect


@dataclass(frozen=True)
class LineSegment:
    """Line segment with the points ``start + s span``, s from 0 to 1.

    Attributes:
        start: (3,) start point, m.
        span: (3,) vector to the end point, m.
        square: ``span' span``, m^2, a number because links are rigid; 0 for a point. An expression is 1 for a point.
    """

    start: SX
    span: SX
    square: float | SX

    def point_at(self, s: SX) -> SX:
        """Return the point (3,) at s."""
        return self.start + s * self.span


def closest_parameters(a: LineSegment, b: LineSegment) -> tuple[SX, SX]:
    """Return the parameters of the closest points: s on a, t on b, each from 0 to 1.

    The closest points of the two lines give s, which is clipped, then t for that s, clipped, then s for that t, clipped. This
    is the minimum of a convex function over a square. If the segments are parallel, so that the lines have no unique closest
    points, the first s is arbitrary and the other two steps still lead to a closest pair.

    Source: Ericson 2005, Real-Time Collision Detection, section 5.1.9.
    """
    start_offset = a.start - b.start
    along_a, along_b, span_product = ca.dot(a.span, start_offset), ca.dot(b.span, start_offset), ca.dot(a.span, b.span)
    if isinstance(a.square, float) and isinstance(b.square, float) and 0 in (a.square, b.square):
        s = ca.SX(0) if a.square == 0 else _clip_to_unit(-along_a / a.square)
        return s, ca.SX(0) if b.square == 0 else _clip_to_unit(along_b / b.square)
    determinant = a.square * b.square - span_product * span_product
    limit = _PARALLEL_TOLERANCE * a.square * b.square
    s = _clip_to_unit((span_product * along_b - b.square * along_a) / ca.if_else(determinant > limit, determinant, limit))
    t = _clip_to_unit((span_product * s + along_b) / b.square)
    return _clip_to_unit((span_product * t - along_a) / a.square), t


def distance_between_points(a: LineSegment, b: LineSegment, s: SX, t: SX) -> SX:
    """Return the distance of the points at s on a and t on b, at least 1e-12 m; see :func:`closest_parameters`."""
    difference = b.point_at(t) - a.point_at(s)
    square = ca.dot(difference, difference)
    return ca.sqrt(ca.if_else(square > _MIN_SQUARE_DISTANCE, square, _MIN_SQUARE_DISTANCE))


def separating_wrench(a: LineSegment, b: LineSegment, s: SX, t: SX) -> SX:
    """Return a unit force that pushes b away from a along the line through their closest points: moment about 0, force, (6,).

    The closest points minimise the distance, so its derivative is that with both points fixed (envelope theorem), which is the
    power of the force. If the axes intersect there is no direction, and the force fades to 0 within 1e-12 m.
    """
    point = b.point_at(t)
    force = (point - a.point_at(s)) / distance_between_points(a, b, s, t)
    return ca.vertcat(ca.cross(point, force), force)


def _clip_to_unit(x: SX) -> SX:
    return ca.if_else(x < 0, 0.0, ca.if_else(x > 1, 1.0, x))
