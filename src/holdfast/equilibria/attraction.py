"""Where starts end up: the share of each stationary point, and for two healthy joints the borders of the basins."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import LARGEST, checked, real_numbers
from holdfast.arm.configurations import finite_limits
from holdfast.arm.task import target_pose
from holdfast.control.law import Law
from holdfast.equilibria.points import StationaryPoints, classified, search
from holdfast.equilibria.stability import Kind
from holdfast.equilibria.system import RestSystem, distinct
from holdfast.errors import InputError
from holdfast.failures import LockedAt, locks_given
from holdfast.notice import says
from holdfast.probability.intervals import Interval, check_confidence
from holdfast.result import Result
from holdfast.simulation.closed_loop import simulate
from holdfast.simulation.runs import Outcome, Runs
from holdfast.solvers import joint_space

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import xarray as xr

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

STARTS = 2000
NEAR = 1e-2  # rad (and m): a run that ends nearer than this to a stationary point ended there
ARRIVED, MOVING, UNDECIDED, STUCK = -1, -2, -3, -4
_WORDS = {ARRIVED: "target", STUCK: "stuck on a continuum", MOVING: "moving", UNDECIDED: "undecided"}
_OFFSET, _LENGTH = 1e-5, 30.0  # rad: where a basin boundary begins, how far it is followed
_SLOW = 1e-6  # rad/s: here it ends, at a source
_SPACING = 0.02
_STALLED = 200  # steps within a spacing: the line is at a singular configuration, where its direction jumps


@dataclass(frozen=True, eq=False, kw_only=True)
class Basins(Result):
    """Where N starts ended.

    Attributes:
        points: Stationary points; those at which runs ended are among them.
        starts: (N, n) rad and m.
        end: (N,) index of the point; or -1 at the target, but not at an isolated solution; -2 moving; -3 undecided; -4 stuck,
            but not at an isolated stationary point.
        runs: The runs.
        confidence: Of the intervals.
        boundaries: Lines of configurations (K, n) that run into saddles, for two healthy joints: starts on either side may end
            at different points. Continuous, so that joints may run beyond pi.
        shape: Starts along each of the two healthy joints, if they are a grid.
        healthy: Joints that move and that the task notices, from 0.
    """

    points: StationaryPoints
    starts: Array
    end: Indices
    runs: Runs
    confidence: float
    boundaries: tuple[Array, ...] = ()
    shape: tuple[int, int] | None = None
    healthy: tuple[int, ...] = ()

    @property
    def shares(self) -> list[tuple[str, Interval]]:
        """Where starts ended, solutions and sinks always, and the share of starts with its exact interval."""
        always = np.isin(self.points.kind, (Kind.SOLUTION, Kind.SINK)) & ~self.points.continuum
        codes = sorted({*self.end.tolist(), *np.flatnonzero(always).tolist()}, key=lambda k: (k < 0, abs(k)))
        return [(self.name(k), Interval.of(int((self.end == k).sum()), len(self.end), self.confidence)) for k in codes]

    def name(self, code: int) -> str:
        """A value of ``end`` for people: the kind and number from 1 of a point, or a word."""
        return _WORDS[code] if code < 0 else f"{Kind(self.points.kind[code]).word} {code + 1}"

    @property
    def converged(self) -> Interval:
        """Share of starts that reach the target."""
        converged = np.asarray(self.runs.code) == Outcome.CONVERGED
        return Interval.of(int(converged.sum()), len(self.end), self.confidence)

    def describe(self) -> list[str]:
        """A few sentences for people."""
        return [self.points.describe()[0], f"{self.converged} of {len(self.end)} starts reach the target"]

    def to_xarray(self) -> xr.Dataset:
        """The starts with their ends: one row each, rad and m; see ``end`` for the codes."""
        import xarray as xr

        values = {"start": (("start_number", "joint"), self.starts), "end": ("start_number", self.end)}
        return xr.Dataset(values, {"joint": list(self.points.law.arm.joint_names)})


@checked
@says("simulating the basins")
def basins(
    law: Law,
    target: ArrayLike,
    locked: LockedAt,
    *,
    starts: int | ArrayLike = STARTS,
    grid: int | None = None,
    seed: int = 0,
    time_limit: float | None = None,
    confidence: float = 0.95,
) -> Basins:
    """Which starts of a failed arm reach the target, and where the others end.

    Starts are drawn uniformly between the limits of the healthy joints, over the whole turn where there are none, and each is
    simulated; its end is matched with the stationary points of :func:`holdfast.stationary_points`.

    Args:
        law: The control law, with its arm, task and gain.
        target: (m,) for tasks without angular rows, or a tool pose (4, 4).
        locked: ``{joint: value}``, rad or m, of one joint or several, by name or index from 0.
        starts: How many random starts, or configurations (N, n), whose locked joints are set to their values.
        grid: With two healthy joints, cell centres of a grid of so many by so many in place of ``starts``.
        seed: Of the random starts and of the search for stationary points.
        time_limit: Of each run, s; 3000/Ke if not given.
        confidence: Of the intervals; of a grid they are what as many random starts would have.

    Raises:
        InputError: Wrong shapes, joints or options.

    Source: Goel et al. 2005, Fig. 8. Matching, shares and intervals are ours.
    """
    check_confidence(confidence)
    (joints, values), pose = locks_given(law.arm, locked), target_pose(law.task, target)
    generator = np.random.default_rng(seed)
    system = RestSystem(law, pose, joints)
    moving = tuple(int(k) for k in np.flatnonzero(system.healthy))
    points = search(system, values, generator)
    q0 = _starts(law, moving, starts, grid, generator)
    q0[:, list(joints)] = values
    runs = simulate(law, q0, pose, locked=list(joints), time_limit=time_limit)
    points = _completed(system, points, runs)
    shape = None if grid is None else (grid, grid)
    lines = tuple(_boundaries(system, points)) if len(moving) == 2 else ()
    return Basins(
        points=points,
        starts=q0,
        end=_ends(system, points, runs),
        runs=runs,
        confidence=confidence,
        boundaries=lines,
        shape=shape,
        healthy=moving,
    )


def _starts(
    law: Law, moving: Sequence[int], starts: int | ArrayLike, grid: int | None, generator: np.random.Generator
) -> Array:
    arm = law.arm
    low, high = finite_limits(arm)
    if grid is not None:
        if len(moving) != 2 or grid < 2:
            raise InputError(
                f"grid is {grid} with {len(moving)} healthy joints; it takes two healthy joints and 2 or more cells"
            )
        share = (np.arange(grid) + 0.5) / grid
        q = np.zeros((grid * grid, arm.n))
        first, second = np.meshgrid(share, share, indexing="ij")
        for k, x in zip(moving, (first, second), strict=True):
            q[:, k] = low[k] + (high[k] - low[k]) * x.ravel()
        return q
    if np.ndim(starts) == 0:
        number = float(real_numbers(starts, "starts"))
        if not 1 <= number <= LARGEST or number != int(number):
            raise InputError(f"starts is {number:g}; it must be a whole number of 1 or more, or configurations")
        count = int(number)
        return np.asarray(generator.uniform(low, high, (count, arm.n)))
    return np.atleast_2d(arm.check_configurations(np.asarray(starts, dtype=np.float64))).copy()


def _completed(system: RestSystem, points: StationaryPoints, runs: Runs) -> StationaryPoints:
    """With points added at which runs stopped though the search did not find them."""
    stuck = _finals(system, runs)[runs.code == Outcome.STUCK]
    new = distinct(system.law.arm, stuck, points.q, NEAR)
    if not len(new):
        return points
    exact = system.settled(new)
    new = np.where(np.isfinite(exact) & (np.abs(exact - new) < NEAR), exact, new)
    return classified(
        system, points.at, np.concatenate([points.q, distinct(system.law.arm, new, points.q, NEAR)]), points.starts
    )


def _finals(system: RestSystem, runs: Runs) -> Array:
    """(N, n) where the runs ended, joints that the task does not notice at 0, as in stationary points."""
    q = runs.q_final.copy()
    q[:, list(system.idle)] = 0.0
    return q


def _ends(system: RestSystem, points: StationaryPoints, runs: Runs) -> Indices:
    """(N,) see :class:`Basins`."""
    codes = {Outcome.CONVERGED: ARRIVED, Outcome.STUCK: STUCK, Outcome.MOVING: MOVING, Outcome.UNDECIDED: UNDECIDED}
    end = np.array([codes[Outcome(c)] for c in runs.code], dtype=np.int64)
    free, finals = points.law.arm.without_limits, _finals(system, runs)
    reached = points.kind == Kind.SOLUTION
    for outcome, alike in ((Outcome.CONVERGED, reached), (Outcome.STUCK, ~reached)):
        rows, among = np.flatnonzero(runs.code == outcome), np.flatnonzero(alike & ~points.continuum)
        if rows.size and among.size:
            away, nearest = joint_space.nearest(free, points.q[among], finals[rows])
            end[rows[away < NEAR]] = among[nearest[away < NEAR]]
    return end


def _boundaries(system: RestSystem, points: StationaryPoints) -> Iterator[Array]:
    """The stable manifolds of the saddles, followed backwards in time at unit speed."""
    rates = system.linear.field(system.pose, system.healthy)

    def back(_: float, q: Array) -> Array:
        now = rates(q)
        return np.asarray(-now / max(float(np.linalg.norm(now)), 1e-12))

    for q in points.q[points.kind == Kind.SADDLE]:
        matrix = system.linear.matrices(q[None], system.pose, system.healthy)[0]
        values, vectors = np.linalg.eig(matrix)
        into = np.zeros(len(q))
        into[system.healthy] = vectors[:, np.argmin(values.real)].real
        for side in (1.0, -1.0):
            start = q + side * _OFFSET * into / np.linalg.norm(into)
            yield _line(back, start, lambda q: float(np.linalg.norm(rates(q))) < _SLOW)


def _line(speed: Callable[[float, Array], Array], start: Array, ended: Callable[[Array], bool]) -> Array:
    """(P, n) a line of unit speed from its start to its end, or to where it cannot go on, as at a singular configuration."""
    from scipy.integrate import RK45, OdeSolution

    solver = RK45(speed, 0.0, start, _LENGTH, rtol=1e-8, atol=1e-10, max_step=0.1)
    times, pieces = [0.0], []
    while solver.status == "running":
        if solver.step() is not None:  # why no step is small enough
            break
        times.append(solver.t)
        pieces.append(solver.dense_output())
        stalled = len(times) > _STALLED and times[-1] - times[-1 - _STALLED] < _SPACING
        if stalled or (solver.t > _SPACING and ended(solver.y)):  # nothing ends where it begins, where all is slow
            break
    if not pieces:
        return start[None]
    return np.asarray(OdeSolution(times, pieces)(np.arange(0, times[-1], _SPACING)).T)
