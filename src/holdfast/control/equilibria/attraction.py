"""Basins of a failed arm: fractions of starts by stationary point, and basin boundaries of two healthy joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.equilibria.points import StationaryPoints, classify_points, find_stationary_points
from holdfast.control.equilibria.stability import Kind
from holdfast.control.equilibria.system import RestSystem, select_distinct
from holdfast.control.laws.law import Law
from holdfast.control.simulation.closed_loop import simulate
from holdfast.control.simulation.runs import RunOutcome, Runs
from holdfast.core.errors import InputError
from holdfast.core.extras import import_extra
from holdfast.core.probability.intervals import Interval, check_confidence
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.core.validation import LARGEST_EXACT_INTEGER, check_arguments, require_real_numbers
from holdfast.kinematics.solvers import joint_space
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.task import target_pose
from holdfast.model.failure_modes import LockedAt, locks_with_values

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import xarray as xr


DEFAULT_STARTS = 2000
END_TOLERANCE = 1e-2  # rad (and m): a run that ends closer than this to a stationary point counts as ending there
END_AT_TARGET = -1
END_MOVING = -2
END_UNDECIDED = -3
END_STUCK = -4
_END_WORDS = {END_AT_TARGET: "target", END_STUCK: "stuck on a continuum", END_MOVING: "moving", END_UNDECIDED: "undecided"}
_BOUNDARY_OFFSET_RAD = 1e-5  # distance from the saddle at which a basin boundary begins
_BOUNDARY_LENGTH_RAD = 30.0  # length to which a basin boundary is followed
_SOURCE_SPEED_RAD_S = 1e-6  # rad/s: a basin boundary ends at a source, where it is slower than this
_LINE_SPACING = 0.02
_STALL_STEPS = 200  # steps within a spacing: the line is at a singular configuration, where its direction jumps


@dataclass(frozen=True, eq=False, kw_only=True)
class Basins(Result):
    """Ends of the motions of a failed arm from N starts.

    Attributes:
        points: Stationary points, including those at which runs ended.
        starts: (N, n) configurations at the start, rad and m.
        end: (N,) index of the stationary point at the end; -1 at the target, but not at an isolated solution; -2 moving;
            -3 undecided; -4 stuck, but not at an isolated stationary point.
        runs: Simulated runs from the starts.
        confidence: Confidence level of the intervals.
        boundaries: Lines of configurations (K, n) that lead into saddles, for two healthy joints. Starts on either side may end
            at different points. The lines are continuous, so joints may exceed pi.
        shape: Number of starts along each of the two healthy joints, if the starts form a grid.
        healthy: Indices from 0 of the joints that can move and that affect the task.
    """

    points: StationaryPoints
    starts: FloatArray
    end: IndexArray
    runs: Runs
    confidence: float
    boundaries: tuple[FloatArray, ...] = ()
    shape: tuple[int, int] | None = None
    healthy: tuple[int, ...] = ()

    @property
    def shares(self) -> list[tuple[str, Interval]]:
        """Ends of the starts, always with solutions and sinks, and the fraction of starts of each with its exact interval."""
        is_isolated_end = np.isin(self.points.kind, (Kind.SOLUTION, Kind.SINK)) & ~self.points.continuum
        codes = sorted({*self.end.tolist(), *np.flatnonzero(is_isolated_end).tolist()}, key=lambda code: (code < 0, abs(code)))
        counts = [int((self.end == code).sum()) for code in codes]
        intervals = [Interval.from_counts(count, len(self.end), self.confidence) for count in counts]
        return list(zip(map(self.name, codes), intervals, strict=True))

    def name(self, code: int) -> str:
        """Return the ``code`` of an entry of ``end`` as text: the kind and number (from 1) of a point, or a word."""
        return _END_WORDS[code] if code < 0 else f"{Kind(self.points.kind[code]).word} {code + 1}"

    @property
    def convergence(self) -> Interval:
        """Fraction of starts that reach the target."""
        converged = np.asarray(self.runs.code) == RunOutcome.CONVERGED
        return Interval.from_counts(int(converged.sum()), len(self.end), self.confidence)

    def to_xarray(self) -> xr.Dataset:
        """Return the starts, rad and m, and their ends in the codes of ``end``, one row for each start.

        Raises:
            HoldfastError: xarray is not installed (extra ``xarray``).
        """
        xr = import_extra("xarray", "xarray")

        values = {"start": (("start_number", "joint"), self.starts), "end": ("start_number", self.end)}
        return xr.Dataset(values, {"joint": list(self.points.law.arm.joint_names)})


@check_arguments
@reports_progress("simulating the basins")
def basins(
    law: Law,
    target: ArrayLike,
    locked: LockedAt,
    *,
    starts: int | ArrayLike = DEFAULT_STARTS,
    grid: int | None = None,
    seed: int = 0,
    time_limit: float | None = None,
    confidence: float = 0.95,
) -> Basins:
    """Determine which starts of a failed arm reach the target, and where the others end.

    Starts are sampled uniformly between the limits of the healthy joints, or over a full turn if there are none. The motion
    from each start is simulated, and its end is matched with the stationary points of :func:`holdfast.stationary_points`.

    Args:
        law: The control law, with its arm, task and gain.
        target: (m,) position, m, for tasks without angular rows; or (4, 4) tool pose.
        locked: Values of one or several locked joints as ``{joint: value}``, rad or m, by name or index from 0.
        starts: Number of random starts, or (N, n) configurations, whose locked joints are set to their values.
        grid: Number of cells along each of two healthy joints; the cell centres of this grid replace ``starts``.
        seed: Seed of the random starts and of the search for stationary points.
        time_limit: Time limit of each run, s. Default: 3000/Ke.
        confidence: Confidence level of the intervals. For a grid they are those of the same number of random starts.

    Raises:
        InputError: Wrong shapes, joints or options.

    Source: Goel et al. 2005, Fig. 8. The matching, fractions and intervals are ours.
    """
    check_confidence(confidence)
    (joints, values), target_matrix = locks_with_values(law.arm, locked), target_pose(law.task, target)
    generator = np.random.default_rng(seed)
    system = RestSystem(law, target_matrix, joints)
    moving_joints = tuple(int(joint) for joint in np.flatnonzero(system.healthy))
    points = find_stationary_points(system, values, generator)
    q0 = _make_starts(law, moving_joints, starts, grid, generator)
    q0[:, list(joints)] = values
    runs = simulate(law, q0, target_matrix, locked=list(joints), time_limit=time_limit)
    points = _add_missed_points(system, points, runs)
    grid_shape = None if grid is None else (grid, grid)
    boundaries = tuple(_trace_boundaries(system, points)) if len(moving_joints) == 2 else ()
    return Basins(
        points=points,
        starts=q0,
        end=_match_ends(system, points, runs),
        runs=runs,
        confidence=confidence,
        boundaries=boundaries,
        shape=grid_shape,
        healthy=moving_joints,
    )


def _make_starts(
    law: Law, moving: Sequence[int], starts: int | ArrayLike, grid: int | None, generator: np.random.Generator
) -> FloatArray:
    arm = law.arm
    lower, upper = sampling_limits(arm)
    if grid is not None:
        if len(moving) != 2 or grid < 2:
            raise InputError(
                f"grid is {grid} with {len(moving)} healthy joints; it takes two healthy joints and 2 or more cells"
            )
        fractions = (np.arange(grid) + 0.5) / grid
        q = np.zeros((grid * grid, arm.n))
        first, second = np.meshgrid(fractions, fractions, indexing="ij")
        for joint, grid_values in zip(moving, (first, second), strict=True):
            q[:, joint] = lower[joint] + (upper[joint] - lower[joint]) * grid_values.ravel()
        return q
    if np.ndim(starts) == 0:
        number = float(require_real_numbers(starts, "starts"))
        if not 1 <= number <= LARGEST_EXACT_INTEGER or number != int(number):
            raise InputError(f"starts is {number:g}; it must be a whole number of 1 or more, or configurations")
        count = int(number)
        return np.asarray(generator.uniform(lower, upper, (count, arm.n)))
    return np.atleast_2d(arm.check_configurations(np.asarray(starts, dtype=np.float64))).copy()


def _add_missed_points(system: RestSystem, points: StationaryPoints, runs: Runs) -> StationaryPoints:
    """Add the points at which runs stopped but which the search did not find."""
    stuck_ends = _final_configurations(system, runs)[runs.code == RunOutcome.STUCK]
    new_points = select_distinct(system.law.arm, stuck_ends, points.q, END_TOLERANCE)
    if not len(new_points):
        return points
    refined = system.refine_points(new_points)
    new_points = np.where(np.isfinite(refined) & (np.abs(refined - new_points) < END_TOLERANCE), refined, new_points)
    return classify_points(
        system,
        points.at,
        np.concatenate([points.q, select_distinct(system.law.arm, new_points, points.q, END_TOLERANCE)]),
        points.starts,
    )


def _final_configurations(system: RestSystem, runs: Runs) -> FloatArray:
    """Return the ends (N, n) of the runs, with joints that do not move the task at 0, as in stationary points."""
    q = runs.q_final.copy()
    q[:, list(system.idle)] = 0.0
    return q


def _match_ends(system: RestSystem, points: StationaryPoints, runs: Runs) -> IndexArray:
    """Return the codes (N,) of :class:`Basins` for the ends of runs."""
    codes = {
        RunOutcome.CONVERGED: END_AT_TARGET,
        RunOutcome.STUCK: END_STUCK,
        RunOutcome.MOVING: END_MOVING,
        RunOutcome.UNDECIDED: END_UNDECIDED,
    }
    end_codes = np.array([codes[RunOutcome(code)] for code in runs.code], dtype=np.int64)
    unlimited_arm, finals = points.law.arm.without_limits, _final_configurations(system, runs)
    is_solution = points.kind == Kind.SOLUTION
    for outcome, is_candidate in ((RunOutcome.CONVERGED, is_solution), (RunOutcome.STUCK, ~is_solution)):
        run_rows, candidates = np.flatnonzero(runs.code == outcome), np.flatnonzero(is_candidate & ~points.continuum)
        if run_rows.size and candidates.size:
            distance, nearest = joint_space.find_nearest(unlimited_arm, points.q[candidates], finals[run_rows])
            end_codes[run_rows[distance < END_TOLERANCE]] = candidates[nearest[distance < END_TOLERANCE]]
    return end_codes


def _trace_boundaries(system: RestSystem, points: StationaryPoints) -> Iterator[FloatArray]:
    """Trace the stable manifolds of the saddles backwards in time at unit speed."""
    rates = system.linear.field(system.pose, system.healthy)

    def reversed_field(_: float, q: FloatArray) -> FloatArray:
        joint_rates = rates(q)
        return np.asarray(-joint_rates / max(float(np.linalg.norm(joint_rates)), 1e-12))

    for q in points.q[points.kind == Kind.SADDLE]:
        matrix = system.linear.matrices(q[None], system.pose, system.healthy)[0]
        values, vectors = np.linalg.eig(matrix)
        direction = np.zeros(len(q))
        direction[system.healthy] = vectors[:, np.argmin(values.real)].real
        for sign in (1.0, -1.0):
            start = q + sign * _BOUNDARY_OFFSET_RAD * direction / np.linalg.norm(direction)
            yield _integrate_line(reversed_field, start, lambda q: float(np.linalg.norm(rates(q))) < _SOURCE_SPEED_RAD_S)


def _integrate_line(
    speed: Callable[[float, FloatArray], FloatArray], start: FloatArray, is_end: Callable[[FloatArray], bool]
) -> FloatArray:
    """Return a line (P, n) of unit speed from its start to its end, or to a singular configuration where it cannot continue."""
    from scipy.integrate import RK45, OdeSolution

    solver = RK45(speed, 0.0, start, _BOUNDARY_LENGTH_RAD, rtol=1e-8, atol=1e-10, max_step=0.1)
    times, interpolants = [0.0], []
    while solver.status == "running":
        if solver.step() is not None:  # the solver found no step small enough
            break
        times.append(solver.t)
        interpolants.append(solver.dense_output())
        is_stalled = len(times) > _STALL_STEPS and times[-1] - times[-1 - _STALL_STEPS] < _LINE_SPACING
        if is_stalled or (solver.t > _LINE_SPACING and is_end(solver.y)):  # a line does not end at its slow beginning
            break
    if not interpolants:
        return start[None]
    return np.asarray(OdeSolution(times, interpolants)(np.arange(0, times[-1], _LINE_SPACING)).T)
