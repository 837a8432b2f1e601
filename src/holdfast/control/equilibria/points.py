"""The points at which a failed arm can stop with its joint locked at a given value, and their kinds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from holdfast.control.equilibria.stability import Kind, Kinds, classify_kinds, is_attracting
from holdfast.control.equilibria.system import RestSystem, select_distinct, wrap_angles
from holdfast.control.laws.law import Law
from holdfast.control.simulation.system import position_and_angle_errors
from holdfast.core.caching import cached_property
from holdfast.core.progress import Progress, ignore_progress
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

WAVE_STARTS = 256
MAX_IDLE_WAVES = 3
MAX_WAVES = 40
POINT_TOLERANCE = 1e-5  # rad (and m): points nearer than this are one
CONTINUUM_SPACING = 0.05  # rad (and m) between points of a continuum
MAX_CONTINUUM_POINTS = 256  # points of a continuum that are kept


@dataclass(frozen=True, eq=False, kw_only=True)
class StationaryPoints(Result):
    """Stationary points of an arm with locked joints, solutions and erroneous ones.

    Attributes:
        law: The control law.
        target: (4, 4) wanted tool pose; a task takes its rows of it.
        locked: Locked joints, from 0.
        at: (k,) their values, rad (or m).
        q: (P, n) rad and m, from -pi to pi: solutions first, then sinks, saddles, sources and degenerate points;
            joints that the task does not notice are at 0.
        kind: (P,) :class:`holdfast.control.equilibria.Kind`.
        eigenvalues: (P, n - k) of the linearised motion of the healthy joints, complex, by falling real part, in units of the
            gain Ke.
        error: (P,) norm of the task's error, m and rad.
        residual: (P,) norm of the healthy joints' rates in units of Ke: 0 but for rounding.
        continuum: (P,) True for points that are not isolated, a sample of what may be a curve or a surface of stationary
            points, as where a spherical shoulder can turn without moving what is locked.
        within_limits: (P,) all joints are within their limits, which the law does not heed.
        starts: Random starts that were used; points that none converges to are missed.
    """

    law: Law
    target: FloatArray
    locked: tuple[int, ...]
    at: FloatArray
    q: FloatArray
    kind: Kinds
    eigenvalues: NDArray[np.complex128]
    error: FloatArray
    residual: FloatArray
    continuum: BoolArray
    within_limits: BoolArray
    starts: int

    def __len__(self) -> int:
        return len(self.q)

    def of_kind(self, *chosen: Kind) -> StationaryPoints:
        """Return only the points of these kinds."""
        return self._subset(np.isin(self.kind, chosen))

    @property
    def kinds(self) -> list[str]:
        """``solution``, ``sink``, ``saddle``, ``source`` or ``degenerate`` of each point."""
        return [Kind(kind).word for kind in self.kind]

    @property
    def position_error(self) -> FloatArray:
        """(P,) distance of the tool point from the target in the directions of the task, m."""
        return self._tool_errors[0]

    @property
    def angle_error(self) -> FloatArray:
        """(P,) angle of the end effector from the target in the directions of the task, rad."""
        return self._tool_errors[1]

    @cached_property
    def _tool_errors(self) -> tuple[FloatArray, FloatArray]:
        return position_and_angle_errors(self.law, self.q, self.error, self.target)

    @property
    def attracting(self) -> BoolArray:
        """(P,) True for sinks, and for points that repel in no direction: those of a continuum that the arm can end on."""
        return is_attracting(self.eigenvalues)

    @property
    def balance(self) -> int:
        """Isolated points that attract or repel all around, minus saddles: sum of the signs of the determinants.

        By Poincare and Hopf the sum for two healthy joints that turn without end is 0 where J is regular everywhere, which
        tells of points that were missed.
        """
        is_isolated = ~self.continuum & np.isfinite(self.eigenvalues).all(axis=1)
        sign_sum = int(np.sign(np.prod(self.eigenvalues[is_isolated], axis=1).real).sum())
        return -sign_sum if self.eigenvalues.shape[1] % 2 else sign_sum

    def _subset(self, rows: BoolArray | IndexArray) -> StationaryPoints:
        names = ("q", "kind", "eigenvalues", "error", "residual", "continuum", "within_limits")
        return replace(self, **{name: getattr(self, name)[rows] for name in names})


def find_stationary_points(
    system: RestSystem, locked_values: FloatArray, generator: np.random.Generator, report_progress: Progress = ignore_progress
) -> StationaryPoints:
    """Find all stationary points that random starts reach with the locked joints at (k,)."""
    # With spare joints the target is reached on curves or surfaces: one wave gives a sample.
    has_spare_joints = int(system.healthy.sum()) > system.law.task.m
    target_waves, search = 1 if has_spare_joints else MAX_WAVES, system.find_target_configurations
    solutions, solution_starts = _gather_points(system, locked_values, search, generator, target_waves, ignore_progress)
    stuck_points, stuck_starts = _gather_points(
        system, locked_values, system.find_stuck_configurations, generator, MAX_WAVES, report_progress
    )
    return classify_points(system, locked_values, np.concatenate([solutions, stuck_points]), solution_starts + stuck_starts)


def _gather_points(
    system: RestSystem,
    locked_values: FloatArray,
    attempt: Callable[[FloatArray], FloatArray],
    generator: np.random.Generator,
    max_waves: int,
    report_progress: Progress,
) -> tuple[FloatArray, int]:
    """Return stationary points (P, n) from waves of starts, until some bring none new and isolated, and the starts used."""
    arm = system.law.arm
    isolated, continuum = np.empty((0, arm.n)), np.empty((0, arm.n))
    starts = idle_waves = 0
    for _ in range(max_waves):
        z = system.sample_starts(WAVE_STARTS, generator)
        z[:, list(system.locked_joints)] = locked_values
        starts += WAVE_STARTS
        candidates = wrap_angles(arm, attempt(z))
        is_isolated = system.is_isolated(candidates)
        new_points = select_distinct(arm, candidates[is_isolated], isolated, POINT_TOLERANCE)
        isolated = np.concatenate([isolated, new_points])
        new_continuum = select_distinct(arm, candidates[~is_isolated], continuum, CONTINUUM_SPACING)
        continuum = np.concatenate([continuum, new_continuum])[:MAX_CONTINUUM_POINTS]
        idle_waves = 0 if len(new_points) else idle_waves + 1
        report_progress(starts, starts + (MAX_IDLE_WAVES - idle_waves) * WAVE_STARTS)  # if nothing new comes
        if idle_waves == MAX_IDLE_WAVES:
            break
    return np.concatenate([isolated, continuum]), starts


def classify_points(system: RestSystem, locked_values: FloatArray, q: FloatArray, starts: int) -> StationaryPoints:
    """Return stationary points q (P, n) with their properties, sorted by kind and error."""
    arm, healthy = system.law.arm, system.healthy
    rates, error, scaled_error = system.linear.rates(q, system.pose)
    eigenvalues = system.eigenvalues(q)
    point_kinds = classify_kinds(eigenvalues, scaled_error)
    points = StationaryPoints(
        law=system.law,
        target=system.pose,
        locked=system.locked_joints,
        at=locked_values,
        q=q,
        kind=point_kinds,
        eigenvalues=eigenvalues,
        error=error,
        residual=np.linalg.norm(rates[:, healthy], axis=1),
        continuum=~system.is_isolated(q),
        within_limits=np.asarray(((q >= arm.lower) & (q <= arm.upper)).all(axis=1)),
        starts=starts,
    )
    return points._subset(np.lexsort((np.round(scaled_error, 9), ~points.attracting, point_kinds)))
