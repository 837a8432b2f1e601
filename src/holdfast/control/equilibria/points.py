"""Points at which a failed arm can stop with its joint locked at a given value, and their kinds."""

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
POINT_TOLERANCE = 1e-5  # rad (and m): points closer than this are equal
CONTINUUM_SPACING = 0.05  # rad (and m) between points of a continuum
MAX_CONTINUUM_POINTS = 256  # points of a continuum that are kept


@dataclass(frozen=True, eq=False, kw_only=True)
class StationaryPoints(Result):
    """P stationary points of an arm with k locked joints: solutions and erroneous points.

    Attributes:
        law: The control law.
        target: (4, 4) tool pose of the target; only the rows of the task count.
        locked: Indices from 0 of the locked joints.
        at: (k,) values of the locked joints, rad (or m).
        q: (P, n) configurations, rad and m, from -pi to pi, in the order solutions, sinks, saddles, sources, degenerate points;
            joints that do not move the task are at 0.
        kind: (P,) :class:`holdfast.control.equilibria.Kind` of each point.
        eigenvalues: (P, n - k) complex eigenvalues of the linearised motion of the healthy joints by decreasing real part, in
            units of the gain Ke.
        error: (P,) norm of the task's error, m and rad.
        residual: (P,) norm of the healthy joints' rates in units of Ke, which is 0 to rounding.
        continuum: (P,) True for points that are not isolated. They are a sample of a curve or surface of stationary points, for
            example of an arm whose spherical shoulder can rotate without moving the locked joint.
        within_limits: (P,) True if all joints are within their limits, which the law does not enforce.
        starts: Number of random starts that were used. The search misses points to which no start converges.
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
        """Return only the points of the ``chosen`` kinds."""
        return self._subset(np.isin(self.kind, chosen))

    @property
    def kinds(self) -> list[str]:
        """Kind of each point as text: ``solution``, ``sink``, ``saddle``, ``source`` or ``degenerate``."""
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
        """(P,) True for points that repel in no direction: sinks, and points of a continuum at which the arm can end."""
        return is_attracting(self.eigenvalues)

    @property
    def balance(self) -> int:
        """Number of isolated points that attract or repel in all directions, minus the number of saddles.

        This is the sum of the signs of the determinants. By the Poincare-Hopf theorem it is 0 for two healthy joints without
        limits if J is regular everywhere, so another value indicates that the search missed points.
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
    """Find all stationary points that random starts reach with the locked joints at ``locked_values`` (k,)."""
    # With redundant joints the target is reached on curves or surfaces, of which one wave gives a sample.
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
    """Return stationary points (P, n) and the number of starts, in waves until some add no new isolated point."""
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
        report_progress(starts, starts + (MAX_IDLE_WAVES - idle_waves) * WAVE_STARTS)  # if the next waves add none
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
