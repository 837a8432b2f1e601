"""Events along a curve of stationary points: folds, branch points, changes of stability, loss of rank, and the target.

Each event is a sign change of a function of the point. It is located by bisection between two points of the curve and is then
inserted as a point. Stability changes where the determinant of the linearisation changes its sign, or where the product of all
sums of two eigenvalues (the determinant of the bialternate sum) does. The second test detects pairs that cross the imaginary
axis while the determinant keeps its sign, which Goel et al. 2005 omit.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from holdfast.control.equilibria.curves import EquilibriumCurve, Segment
from holdfast.control.equilibria.stability import Kind, classify_kinds
from holdfast.control.equilibria.system import RestSystem
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

EVENT_SPACING = 1e-4  # rad and m: events closer than this coincide
_EVENT_BISECTIONS = 44
_EVENT_NEWTON_STEPS = 3
_CROSSING_FRACTION = 1e-3  # fraction of the largest singular value; smaller ones belong to directions of a crossing curve


class CurveEvent(IntEnum):
    """Event at a point of a curve, in the order of the test functions.

    ``FOLD``: the locked value reverses. ``BRANCH``: another curve crosses. ``RANK_LOSS``: the Jacobian loses rank.
    ``TARGET``: the target is reached. ``DETERMINANT`` and ``PAIR``: the determinant, or a sum of two eigenvalues, is 0.
    """

    FOLD = 0
    BRANCH = 1
    RANK_LOSS = 2
    TARGET = 3
    DETERMINANT = 4
    PAIR = 5


def make_curve_with_events(system: RestSystem, joint: int, z: FloatArray, closed: bool, is_constant: bool) -> EquilibriumCurve:
    """Make a curve from its traced points z (K, size), with all events inserted as points."""
    n = system.law.arm.n
    tests, tangents = _evaluate_event_tests(system, joint, z, np.gradient(z, axis=0))
    skipped_events = (CurveEvent.FOLD, CurveEvent.DETERMINANT, CurveEvent.PAIR) if is_constant else ()
    signs = np.sign(tests)
    changes_sign = (signs[1:] * signs[:-1] < 0) & ~np.isin(np.arange(len(CurveEvent)), skipped_events)
    step_index, event_index = np.nonzero(changes_sign)
    steps = CurveSteps(system, z[step_index], z[step_index + 1], tangents[step_index], tangents[step_index + 1])
    fraction, points = _bisect_events(system, joint, steps, event_index, signs[step_index, event_index])
    position = np.concatenate([np.arange(len(z), dtype=float), step_index + fraction])
    label = np.concatenate([np.full(len(z), -1), event_index])
    order = np.argsort(position, kind="stable")
    z, label = np.concatenate([z, points])[order], label[order]
    q = z[:, :n]
    eigenvalues, (_, error, scaled_error) = system.eigenvalues(q), system.linear.rates(q, system.pose)
    point_kinds = np.full(len(q), Kind.DEGENERATE, dtype=np.uint8) if is_constant else classify_kinds(eigenvalues, scaled_error)
    point_kinds[label == CurveEvent.TARGET] = Kind.SOLUTION
    segments = (
        (Segment(Kind.DEGENERATE, 0, len(q) - 1),) if is_constant else _split_curve_by_kind(system, z, label, point_kinds)
    )
    return EquilibriumCurve(
        q=q,
        joint=joint,
        kind=point_kinds,
        eigenvalues=eigenvalues,
        error=error,
        closed=closed,
        degenerate=is_constant,
        folds=np.flatnonzero(label == CurveEvent.FOLD),
        branch_points=np.flatnonzero(label == CurveEvent.BRANCH),
        rank_losses=np.flatnonzero(label == CurveEvent.RANK_LOSS),
        solutions=np.flatnonzero(label == CurveEvent.TARGET),
        hopf_points=np.flatnonzero((label == CurveEvent.PAIR) & _has_imaginary_pair(eigenvalues)),
        segments=segments,
    )


@dataclass(frozen=True)
class CurveSteps:
    """N steps along a curve, from one point to the next.

    Attributes:
        system: Equations of rest that the curve satisfies.
        start, end: (N, size) unknowns at the ends of each step.
        start_tangent, end_tangent: (N, size) unit tangents at the ends of each step.
    """

    system: RestSystem
    start: FloatArray
    end: FloatArray
    start_tangent: FloatArray
    end_tangent: FloatArray

    def interpolate(self, fraction: FloatArray) -> FloatArray:
        """Return points (N, size) at a fraction (N,) of the steps: a cubic that is corrected to the curve.

        Where another curve crosses, the correction is undefined in the direction of that curve, so the cubic is not corrected.
        """
        x = fraction[:, None]
        displacement, active = self.end - self.start, self.system.active
        length = np.linalg.norm(displacement, axis=1, keepdims=True)
        z = self.start + x * x * (3 - 2 * x) * displacement
        z += x * (1 - x) * length * ((1 - x) * self.start_tangent - x * self.end_tangent)
        normal = displacement[:, None, active] / length[:, None]
        plane_offset = np.einsum("ij,ij->i", normal[:, 0], z[:, active])
        for _ in range(_EVENT_NEWTON_STEPS):
            values, jacobian = self.system.evaluate_equations(z)
            plane_error = np.einsum("ij,ij->i", normal[:, 0], z[:, active]) - plane_offset
            inverse = np.linalg.pinv(np.concatenate([jacobian, normal], axis=1), rcond=_CROSSING_FRACTION)
            z[:, active] -= np.einsum("ijk,ik->ij", inverse, np.column_stack([values, plane_error]))
        return z


def _evaluate_event_tests(system: RestSystem, joint: int, z: FloatArray, forward: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the test functions (N, 6), whose sign changes are events, and the unit tangents (N, size)."""
    _, jacobian = system.evaluate_equations(z)
    tangent = np.zeros_like(z)
    tangent[:, system.active] = np.linalg.svd(jacobian)[2][:, -1]
    tangent *= np.sign(np.einsum("ij,ij->i", tangent, forward))[:, None]
    branch_test = np.linalg.slogdet(np.concatenate([jacobian, tangent[:, None, system.active]], axis=1))[0]
    eigenvalues = system.eigenvalues(z[:, : system.law.arm.n])
    first, second = np.triu_indices(eigenvalues.shape[1], 1)
    pair_test = np.prod(eigenvalues[:, first] + eigenvalues[:, second], axis=1).real
    target_test = system.equations.columns.view_parts(z)["s"][:, 0]
    stability_test = np.prod(eigenvalues, axis=1).real
    tests = [tangent[:, joint], branch_test, system.locked_rates_residual(z), target_test, stability_test, pair_test]
    return np.stack(tests, axis=1), tangent


def _bisect_events(
    system: RestSystem, joint: int, steps: CurveSteps, event_index: IndexArray, sign: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the fraction of each step at which a test function changes its sign, and the points there."""
    row_index, forward = np.arange(len(event_index)), steps.end - steps.start
    lower, upper = np.zeros(len(event_index)), np.ones(len(event_index))
    points = steps.start.copy()
    for _ in range(_EVENT_BISECTIONS if len(event_index) else 0):
        middle = (lower + upper) / 2
        points = steps.interpolate(middle)
        is_same_sign = np.sign(_evaluate_event_tests(system, joint, points, forward)[0][row_index, event_index]) == sign
        lower, upper = np.where(is_same_sign, middle, lower), np.where(is_same_sign, upper, middle)
    return (lower + upper) / 2, points


def _split_curve_by_kind(system: RestSystem, z: FloatArray, label: IndexArray, kind: NDArray[np.uint8]) -> tuple[Segment, ...]:
    """Split a curve into sections of one kind between events."""
    n, segments = system.law.arm.n, list[Segment]()
    # Coinciding events of several functions leave sections of zero length between them.
    last_index = len(z) - 1
    end_distance = np.minimum(np.linalg.norm(z - z[0], axis=1), np.linalg.norm(z - z[last_index], axis=1))
    cuts = [0, *np.flatnonzero((label >= 0) & (end_distance > EVENT_SPACING))]
    for start, end in itertools.pairwise([*cuts, last_index]):
        if np.linalg.norm(z[end] - z[start]) <= EVENT_SPACING:
            continue
        inner_kinds = kind[start + 1 : end]
        inner_kinds = inner_kinds[np.isin(inner_kinds, (Kind.SINK, Kind.SADDLE, Kind.SOURCE))]
        if not len(inner_kinds):
            chord = (z[[end]] - z[[start]]) / np.linalg.norm(z[end] - z[start])
            middle = CurveSteps(system, z[[start]], z[[end]], chord, chord).interpolate(np.array([0.5]))[:, :n]
            inner_kinds = classify_kinds(system.eigenvalues(middle), system.linear.rates(middle, system.pose)[2])
        segment_kind = Kind(int(inner_kinds[len(inner_kinds) // 2]))
        if (
            segments
            and segments[-1].kind == segment_kind
            and not (label[segments[-1].first + 1 : end] == CurveEvent.FOLD).any()
        ):
            segments[-1] = Segment(segment_kind, segments[-1].first, int(end))
        else:
            segments.append(Segment(segment_kind, int(start), int(end)))
    return tuple(segments)


def _has_imaginary_pair(eigenvalues: NDArray[np.complex128]) -> BoolArray:
    """Return a mask (N,) of the points at which a complex pair lies on the imaginary axis."""
    scale = np.maximum(1.0, np.abs(eigenvalues).max(axis=1, initial=0.0))[:, None]
    return np.asarray(((np.abs(eigenvalues.real) < 1e-6 * scale) & (np.abs(eigenvalues.imag) > 1e-6 * scale)).any(axis=1))
