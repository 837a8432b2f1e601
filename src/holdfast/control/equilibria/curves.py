"""Curves that stationary points form as one locked joint's value changes, and the parts where the arm gets stuck."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.control.equilibria.stability import Kind, Kinds
from holdfast.control.equilibria.system import RestSystem, wrap_angles
from holdfast.control.laws.law import Law
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.kinematics.solvers.joint_space import join_intervals

if TYPE_CHECKING:
    from holdfast.control.equilibria.points import StationaryPoints

Arc = tuple[float, float]

FULL_TURN_RAD = 2 * np.pi
ARC_TOLERANCE = 3e-5  # rad (and m): arcs closer than this are merged; where curves cross, ends are known to about 1e-5
SAMPLE_RADIUS = 0.1  # rad (and m): sampled values closer than this are reported as one range
ANGLE_TOLERANCE = 1e-6  # rad (and m): degenerate curves at locked values closer than this have the same value


@dataclass(frozen=True)
class Segment:
    """Section of a curve on which the kind of the points does not change.

    Attributes:
        kind: Kind of all points of the section except its ends.
        first: Index of the first point of the section on the curve.
        last: Index of the last point of the section on the curve.
    """

    kind: Kind
    first: int
    last: int


@dataclass(frozen=True, eq=False, kw_only=True)
class EquilibriumCurve:
    """Curve of K erroneous stationary points over the value of one locked joint.

    Attributes:
        q: (K, n) points in order, rad and m, continuous, so joints may exceed pi. The last point of a closed curve equals its
            first point modulo full turns.
        joint: Index from 0 of the locked joint.
        kind: (K,) :class:`holdfast.control.equilibria.Kind` of each point; ``SOLUTION`` where the curve passes the target.
        eigenvalues: (K, h) eigenvalues of the linearised motion of the h healthy joints by decreasing real part, in units of
            the gain Ke; NaN where J loses rank.
        error: (K,) norm of the task's error, m and rad.
        closed: True if the curve returns to its first point.
        degenerate: True if the whole curve lies at one locked value. It is then a continuum of stationary points, each with
            an eigenvalue 0.
        folds: Indices of points where the locked value reverses its direction.
        branch_points: Indices of points where another curve crosses.
        rank_losses: Indices of points where the Jacobian loses rank, so that the law has no answer.
        solutions: Indices of points where the target is reached.
        hopf_points: Indices of points where a complex pair of eigenvalues crosses the imaginary axis.
        segments: Sections of the curve with points of one kind.
    """

    q: FloatArray
    joint: int
    kind: Kinds
    eigenvalues: NDArray[np.complex128]
    error: FloatArray
    closed: bool
    degenerate: bool
    folds: IndexArray
    branch_points: IndexArray
    rank_losses: IndexArray
    solutions: IndexArray
    hopf_points: IndexArray
    segments: tuple[Segment, ...]

    @property
    def locked_values(self) -> FloatArray:
        """(K,) values of the locked joint, rad (or m)."""
        return self.q[:, self.joint]

    @property
    def sinks(self) -> list[Arc]:
        """Ranges ``(lower, upper)`` of locked values at which the curve is a sink, rad (or m), in the order of the curve."""
        return self.arcs(Kind.SINK)

    def arcs(self, kind: Kind) -> list[Arc]:
        """Return the ranges ``(lower, upper)`` of locked values, rad (or m), of the segments of one ``kind``."""
        segments = [segment for segment in self.segments if segment.kind == kind]
        ends = [np.sort(self.locked_values[[segment.first, segment.last]]).tolist() for segment in segments]
        return [(lower, upper) for lower, upper in ends]


@dataclass(frozen=True, eq=False, kw_only=True)
class Curves(Result):
    """All curves of erroneous stationary points that were found for one locked joint.

    Attributes:
        law: The control law.
        target: (4, 4) tool pose of the target; only the rows of the task count.
        joint: Index from 0 of the locked joint.
        curves: Curves of stationary points over the locked value.
        loose: Sample of stationary points that lie on surfaces instead of curves, each with its own locked value. An example
            is an arm with a spherical shoulder, which can rotate without moving the locked joint.
        starts: Number of random starts that were used. The search misses curves to which no start converges.
    """

    law: Law
    target: FloatArray
    joint: int
    curves: tuple[EquilibriumCurve, ...]
    loose: StationaryPoints
    starts: int
    _system: RestSystem = field(repr=False)

    def __len__(self) -> int:
        return len(self.curves)

    @property
    def sink_arcs(self) -> list[Arc]:
        """Disjoint ranges ``(lower, upper)`` of locked values at which the arm can get stuck at a sink, by lower end, rad or m.

        For a revolute joint, lower is in [-pi, pi), and upper, less than a turn above, may exceed pi; ``[(-pi, pi)]`` is every
        value. Outside, no sink was found, which does not exclude limit cycles or slow motion close to degenerate values.
        """
        arcs = [arc for curve in self.curves if not curve.degenerate for arc in curve.sinks]
        return merge_arcs(arcs, is_revolute=not self.law.arm.joints[self.joint].prismatic)

    @property
    def degenerate_angles(self) -> list[float]:
        """Sorted locked values at which whole curves of stationary points exist, rad in (-pi, pi] (or m)."""
        values = [np.median(curve.q, axis=0) for curve in self.curves if curve.degenerate]
        if not values:
            return []
        shift = np.zeros(self.law.arm.n)
        shift[self.joint] = ANGLE_TOLERANCE  # -pi and pi are the same angle, so both become pi
        angles = np.sort((wrap_angles(self.law.arm, np.array(values) - shift) + shift)[:, self.joint])
        return [float(angle) for angle in angles[np.r_[True, np.diff(angles) > ANGLE_TOLERANCE]]]

    def points_at(self, value: float) -> FloatArray:
        """Return the stationary points (P, n) at one locked ``value``, rad (or m), on the curves that are not degenerate."""
        arm = self.law.arm
        points = [np.empty((0, arm.n))]
        for curve in self.curves:
            if curve.degenerate:
                continue
            differences = curve.locked_values - value
            if not arm.joints[self.joint].prismatic:
                differences = (differences + np.pi) % FULL_TURN_RAD - np.pi
            crossings = np.flatnonzero(
                (differences[1:] * differences[:-1] <= 0) & (np.abs(np.diff(differences)) < 1.0) & (differences[:-1] != 0)
            )
            fraction = differences[crossings] / (differences[crossings] - differences[crossings + 1])
            q = curve.q[crossings] + fraction[:, None] * (curve.q[crossings + 1] - curve.q[crossings])
            q[:, self.joint] = value
            points.append(self._system.refine_points(q))
        return wrap_angles(arm, np.concatenate(points))


def merge_arcs(arcs: Sequence[Arc], is_revolute: bool) -> list[Arc]:
    """Merge overlapping arcs ``(lower, upper)``; those of a revolute joint modulo full turns, with lower in [-pi, pi)."""
    if not is_revolute:
        return join_intervals(arcs, ARC_TOLERANCE)
    starts = [((lower + np.pi) % FULL_TURN_RAD - np.pi, upper - lower) for lower, upper in arcs]
    joined = join_intervals(((lower, lower + length) for lower, length in starts), ARC_TOLERANCE, FULL_TURN_RAD)
    return [(-np.pi, np.pi)] if any(upper - lower >= FULL_TURN_RAD - ARC_TOLERANCE for lower, upper in joined) else joined
