"""The curves that stationary points make as the value of one locked joint changes, and where on them the arm gets stuck."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.control.law import Law
from holdfast.equilibria.stability import Kind, Kinds
from holdfast.equilibria.system import RestSystem, wrapped
from holdfast.result import Result

if TYPE_CHECKING:
    from holdfast.equilibria.points import StationaryPoints

Array = NDArray[np.float64]
Indices = NDArray[np.intp]
Arc = tuple[float, float]

TURN = 2 * np.pi
TOUCH = 3e-5  # rad (and m): arcs this far apart are one; where curves cross, ends are known to about 1e-5
NEARBY = 0.1  # rad (and m): sampled values this near are told as one range


@dataclass(frozen=True)
class Segment:
    """A stretch of a curve on which the kind does not change.

    Attributes:
        kind: Of all its points but its ends.
        first, last: Its ends, as indices of points of the curve.
    """

    kind: Kind
    first: int
    last: int


@dataclass(frozen=True, eq=False, kw_only=True)
class Curve:
    """One curve of erroneous stationary points over the locked value.

    Attributes:
        q: (K, n) points in order, rad and m, continuous: joints may run beyond pi. The last point of a closed curve is its
            first again, whole turns apart.
        joint: The locked one, from 0.
        kind: (K,) :class:`holdfast.equilibria.Kind`; ``SOLUTION`` where the curve passes the target.
        eigenvalues: (K, h) of the healthy joints' linearised motion, by falling real part, in units of the gain Ke; NaN where J
            loses rank.
        error: (K,) norm of the task's error, m and rad.
        closed: It comes back to its first point.
        degenerate: The whole curve lies at one locked value: a continuum of stationary points, each with an eigenvalue 0.
        folds: Indices of points where the locked value turns back.
        branch_points: Of points where another curve crosses.
        rank_losses: Of points where the Jacobian loses rank; the law has no answer there.
        solutions: Of points where the target is reached.
        hopf_points: Of points where a complex pair of eigenvalues crosses the imaginary axis.
        segments: Stretches of one kind.
    """

    q: Array
    joint: int
    kind: Kinds
    eigenvalues: NDArray[np.complex128]
    error: Array
    closed: bool
    degenerate: bool
    folds: Indices
    branch_points: Indices
    rank_losses: Indices
    solutions: Indices
    hopf_points: Indices
    segments: tuple[Segment, ...]

    @property
    def locked(self) -> Array:
        """(K,) the locked value, rad (or m)."""
        return self.q[:, self.joint]

    @property
    def sinks(self) -> list[Arc]:
        """Locked values at which the curve is a sink, ``(lower, upper)``, as they run along the curve."""
        return self.arcs(Kind.SINK)

    def arcs(self, kind: Kind) -> list[Arc]:
        """Locked values of each segment of a kind, ``(lower, upper)``."""
        ends = [sorted((float(self.locked[s.first]), float(self.locked[s.last]))) for s in self.segments if s.kind == kind]
        return [(low, high) for low, high in ends]


@dataclass(frozen=True, eq=False, kw_only=True)
class Curves(Result):
    """All curves of erroneous stationary points that were found for one locked joint.

    Attributes:
        law: The control law.
        target: (4, 4) wanted tool pose; a task takes its rows of it.
        joint: The locked one, from 0.
        curves: The curves.
        loose: Stationary points that lie on surfaces rather than curves, a sample, each with its own locked value; as of arms
            with a spherical shoulder, which can turn without moving what is locked.
        starts: Random starts that were used; curves that none converges to are missed.
    """

    law: Law
    target: Array
    joint: int
    curves: tuple[Curve, ...]
    loose: StationaryPoints
    starts: int
    _system: RestSystem = field(repr=False)

    def __len__(self) -> int:
        return len(self.curves)

    @property
    def sink_arcs(self) -> list[Arc]:
        """Locked values at which the arm can get stuck at a sink: disjoint ``(lower, upper)``, by lower end.

        Of a revolute joint lower is in [-pi, pi), and upper, less than a turn above, may pass pi; ``[(-pi, pi)]`` is every
        value. Outside no sink was found, which does not exclude limit cycles or slow motion beside degenerate values.
        """
        arcs = [arc for curve in self.curves if not curve.degenerate for arc in curve.sinks]
        return merged(arcs, turning=not self.law.arm.joints[self.joint].prismatic)

    @property
    def degenerate_angles(self) -> list[float]:
        """Locked values, by size, of whole curves of stationary points; rad from -pi to pi (or m)."""
        values = [np.median(c.q, axis=0) for c in self.curves if c.degenerate]
        if not values:
            return []
        angles = np.sort(wrapped(self.law.arm, np.array(values))[:, self.joint])
        return [float(x) for x in angles[np.r_[True, np.diff(angles) > 1e-6]]]

    def at(self, value: float) -> Array:
        """(P, n) stationary points at one locked value, rad (or m): where curves that are not degenerate pass it."""
        arm = self.law.arm
        found = [np.empty((0, arm.n))]
        for curve in self.curves:
            if curve.degenerate:
                continue
            away = curve.locked - value
            if not arm.joints[self.joint].prismatic:
                away = (away + np.pi) % TURN - np.pi
            crosses = np.flatnonzero((away[1:] * away[:-1] <= 0) & (np.abs(np.diff(away)) < 1.0) & (away[:-1] != 0))
            share = away[crosses] / (away[crosses] - away[crosses + 1])
            q = curve.q[crosses] + share[:, None] * (curve.q[crosses + 1] - curve.q[crosses])
            q[:, self.joint] = value
            found.append(self._system.settled(q))
        return wrapped(arm, np.concatenate(found))

    def describe(self) -> list[str]:
        """A few sentences for people."""
        arm = self.law.arm
        factor, unit = arm.joints[self.joint].shown
        name = arm.joint_names[self.joint]
        lines = [
            f"{arm.title} under {self.law.describe()}, {name} locked at any value: {len(self)} curves, {self.starts} starts"
        ]
        arcs = ", ".join(f"{factor * a:.3f} to {factor * b:.3f}" for a, b in self.sink_arcs)
        lines.append(f"sinks with {name} at {arcs} {unit}" if arcs else "no sinks were found")
        values = ", ".join(f"{factor * x:.4f}" for x in self.degenerate_angles)
        lines += [f"whole curves of stationary points with {name} at {values} {unit}"] if values else []
        if len(self.loose):
            stuck = self.loose.attracting
            near = merged([(float(x) - NEARBY, float(x) + NEARBY) for x in self.loose.q[stuck, self.joint]], unit == "deg")
            arcs = ", ".join(f"{factor * (a + NEARBY):.0f} to {factor * (b - NEARBY):.0f}" for a, b in near)
            where = f", about {arcs} {unit}" if near else ""
            lines.append(f"{len(self.loose)} samples of surfaces of stationary points, {int(stuck.sum())} attracting{where}")
        return lines


def merged(arcs: Sequence[Arc], turning: bool) -> list[Arc]:
    """Arcs ``(lower, upper)`` united; of a revolute joint modulo whole turns, each with lower in [-pi, pi)."""
    if not turning:
        return _united(sorted(arcs))
    starts = [((low + np.pi) % TURN - np.pi, high - low) for low, high in arcs]
    united = _united(sorted((low, low + size) for low, size in starts))
    # What reaches beyond pi comes round to the first arcs.
    while len(united) > 1 and united[0][0] + TURN <= united[-1][1] + TOUCH:
        _, high = united.pop(0)
        united[-1] = (united[-1][0], max(united[-1][1], high + TURN))
    return [(-np.pi, np.pi)] if any(high - low >= TURN - TOUCH for low, high in united) else united


def _united(arcs: Sequence[Arc]) -> list[Arc]:
    """Sorted arcs on a line, those that touch made one."""
    out: list[Arc] = []
    for low, high in arcs:
        if out and low <= out[-1][1] + TOUCH:
            out[-1] = (out[-1][0], max(out[-1][1], high))
        else:
            out.append((low, high))
    return out
