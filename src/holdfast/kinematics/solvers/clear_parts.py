"""Parts of a curve of configurations that meet an inequality such as a clearance, proved also between the points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.curve_tracing import Component, ManifoldTracer
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.collision.clearance import Clearance

MIN_BOUNDED_CHANGE = 5e-4  # m or rad of possible change: a segment that is not proved at this size ends the part
# Largest distance of the middle of a segment from the curve, relative to its length; a half is then at most 0.75 as long.
_MAX_STRAY_FRACTION = 0.25
_LENGTH_FACTOR = 1.1  # a curve is longer than the straight segment between two of its points by less than this factor


@dataclass(frozen=True)
class CurveConstraint:
    """Inequalities on configurations, with bounds of their rates of change.

    Attributes:
        evaluate_margins: Function of configurations (N, n) that returns P margins (N, P), m or rad; below 0 one is violated.
        lipschitz_bounds: (P, n) bounds of the change of each margin, m or rad per rad and m.
        pair_names: (P,) names for the end of a part, where a margin is used up.
    """

    evaluate_margins: Callable[[FloatArray], FloatArray]
    lipschitz_bounds: FloatArray
    pair_names: Sequence[str]

    @classmethod
    def from_clearance(cls, clearance: Clearance, margin: float) -> CurveConstraint:
        """Return the distance of every pair of a clearance beyond its margin, for configurations within the arm's limits."""

        def evaluate_margins(q: FloatArray) -> FloatArray:
            return np.asarray(clearance.by_pair(q) - clearance.margins - margin)

        return cls(evaluate_margins, clearance.lipschitz_bounds(*sampling_limits(clearance.arm)), clearance.pair_names)

    def is_satisfied(self, q: FloatArray) -> BoolArray:
        """Return (N,) True where all inequalities are met at q (N, n)."""
        return np.asarray((self.evaluate_margins(q) >= 0).all(axis=1))

    def find_feasible_parts(self, tracer: ManifoldTracer, pose: FloatArray, curve: Component) -> list[Component]:
        """Return the parts of a curve of a pose (4, 4) that meet the inequalities, in order, with the names of the pairs at the
        ends.

        Between two points with margins d_1 and d_2, the margin is at least ``(d_1 + d_2 - L) / 2``, where L bounds its change
        (for a distance by :meth:`Clearance.lipschitz_bounds`). Segments for which this does not suffice are bisected, by points
        projected onto the pose, until it suffices or L is below half a millimetre, where a part ends.
        """
        q = curve.q
        if curve.closed:
            q = np.concatenate([q, q[-1] + joint_space.joint_difference(tracer.arm, q[:1], q[-1])])
        margins = self.evaluate_margins(q)
        while True:
            is_free = margins.min(axis=1) >= 0
            max_change = _LENGTH_FACTOR * np.abs(np.diff(q, axis=0)) @ self.lipschitz_bounds.T
            proved = is_free[1:] & is_free[:-1] & ((margins[1:] + margins[:-1] - max_change).min(axis=1) >= 0)
            undecided = np.flatnonzero(~proved & (is_free[1:] | is_free[:-1]) & (max_change.max(axis=1) >= MIN_BOUNDED_CHANGE))
            if not undecided.size:
                break
            segments, midpoints = q[undecided + 1] - q[undecided], (q[undecided] + q[undecided + 1]) / 2
            middle, on_curve, _ = tracer.project_onto_poses(midpoints, np.broadcast_to(pose, (undecided.size, 4, 4)))
            # Near a singular configuration the projection may land anywhere, and halves would not get shorter.
            on_curve &= np.linalg.norm(middle - midpoints, axis=1) <= _MAX_STRAY_FRACTION * np.linalg.norm(segments, axis=1)
            middle[~on_curve] = midpoints[~on_curve]
            middle_margins = self.evaluate_margins(middle)
            middle_margins[~on_curve] = -np.inf
            q = np.insert(q, undecided + 1, middle, axis=0)
            margins = np.insert(margins, undecided + 1, middle_margins, axis=0)
        if proved.all():
            return [curve]
        return self._cut_proved_parts(curve, q, margins, proved)

    def _cut_proved_parts(self, curve: Component, q: FloatArray, margins: FloatArray, proved: BoolArray) -> list[Component]:
        """Return the runs of proved segments between points q (K, n)."""
        if curve.closed:  # begin after a segment that is not proved
            cut_index = int(np.flatnonzero(~proved)[0]) + 1
            continued = q[1:] + (q[-1] - q[0])
            q = np.concatenate([q[cut_index:], continued[:cut_index]])
            margins = np.concatenate([margins[cut_index:], margins[1 : cut_index + 1]])
            proved = np.concatenate([proved[cut_index:], proved[:cut_index]])
        edges = np.flatnonzero(np.diff(np.r_[False, proved, False].astype(np.int8)))
        parts = []
        for start, end in zip(edges[::2], edges[1::2], strict=True):
            is_cut = (start > 0 or curve.closed, end < len(q) - 1 or curve.closed)
            end_names = tuple(
                self._find_blocking_pair(margins[index], margins[outer_index % len(margins)]) if cut else ""
                for cut, index, outer_index in ((is_cut[0], start, start - 1), (is_cut[1], end, end + 1))
            )
            bounds = tuple(None if cut else joint for cut, joint in zip(is_cut, curve.bounded_by, strict=True))
            part = q[start : end + 1]
            length = float(np.linalg.norm(np.diff(part, axis=0), axis=1).sum())
            parts.append(
                replace(
                    curve,
                    q=part,
                    closed=False,
                    bounded_by=(bounds[0], bounds[1]),
                    barred_by=(end_names[0], end_names[1]),
                    length=length,
                )
            )
        return parts

    def _find_blocking_pair(self, inside: FloatArray, outside: FloatArray) -> str:
        """Name the pair at the end of a part: the smallest margin just beyond the end, or at the end if none is known."""
        margins = outside if np.isfinite(outside).all() else inside
        return self.pair_names[int(np.argmin(margins))]
