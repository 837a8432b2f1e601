"""Planners that the suite compares, each from a case to a motion: ours and the usual ones."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.bench.cases import Case
from holdfast.bench.judge import NEAR, TURN, Motion, trouble
from holdfast.clearance.clearance import Clearance
from holdfast.errors import HoldfastError
from holdfast.paths.path import line
from holdfast.recovery.goals import configurations_of
from holdfast.recovery.recovery import Answer
from holdfast.recovery.routes import find_route
from holdfast.recovery.rows import row_solver
from holdfast.recovery.search import recover
from holdfast.recovery.space import Metric, Space

Array = NDArray[np.float64]
Rng = np.random.Generator

STARTS = 256  # of the search for a configuration of the goal, of every planner that needs one
_RESTARTS = 8
_SPACING = 0.01  # m or rad of the end effector between poses that differential inverse kinematics follows
_STEP = 0.1  # rad or m that a joint may move between two of them
_NEWTON = 10  # steps at each of them
_AIM = 0.1  # of the tolerances that count, which differential inverse kinematics aims at


@dataclass(frozen=True, eq=False)
class Attempt:
    """What became of a case.

    Attributes:
        verdict: What the planner says.
        motion: What it gives, if anything.
        within: What it proves holds for all that the judge accepts, too.
    """

    verdict: Answer
    motion: Motion | None = None
    within: bool = False


@dataclass(frozen=True)
class Limit:
    """When to stop.

    Attributes:
        seconds: From when it was made.
        begin: When that was, s.
    """

    seconds: float
    begin: float

    @classmethod
    def of(cls, seconds: float) -> Limit:
        """From now on."""
        return cls(seconds, time.perf_counter())

    @property
    def over(self) -> bool:
        """The time is up."""
        return time.perf_counter() - self.begin > self.seconds


def _recover(case: Case, clearance: Clearance | None, limit: Limit, rng: Rng) -> Attempt:
    """:func:`holdfast.recover`."""
    answer = recover(
        case.degraded.arm,
        case.degraded,
        case.at,
        goal=case.goal,
        task=case.rows,
        path=case.path,
        keep=case.keep,
        clearance=False if clearance is None else clearance,
        samples=0,
        starts=STARTS,
        time_limit=limit.seconds,
        tolerance=(NEAR, TURN),
        seed=int(rng.integers(2**31)),
    )
    if not answer.ok:
        return Attempt(answer.verdict.answer, within=answer.proved_within)
    along = next((leg for leg in answer.legs if leg.name == "along the path"), None)
    share = np.zeros(0) if along is None or answer.rest is None else answer.rest.share
    return Attempt(answer.verdict.answer, Motion(answer.q, first=0 if along is None else along.first, share=share))


def _differential(case: Case, clearance: Clearance | None, limit: Limit, rng: Rng, restarts: int = 1) -> Attempt:
    """Newton's method from pose to pose, joints kept within their limits; from the start, then by way of others."""
    for way in _ways(case, restarts, rng):
        if limit.over:
            break
        motion = _followed(case, way)
        if motion is not None and not trouble(case, motion, clearance):
            return Attempt("solved", motion)
    return Attempt("undecided")


def _with_restarts(case: Case, clearance: Clearance | None, limit: Limit, rng: Rng) -> Attempt:
    return _differential(case, clearance, limit, rng, _RESTARTS)


def _ways(case: Case, restarts: int, rng: Rng) -> Iterator[Array]:
    """(K, n) to where following begins: where the arm is, or straight on from there to somewhere else."""
    yield case.at[None]
    arm, moves = case.degraded.limited, case.degraded.moves
    solver = row_solver(arm, case.rows)
    low, high = finite_limits(arm)
    for _ in range(restarts - 1):
        q = np.where(moves, rng.uniform(low, high), case.at)[None]
        if case.path is not None:
            q = solver.run(q, case.path.pose(0.0)[None], np.ones((1, solver.rows.m)), moves)
        yield np.concatenate([case.at[None], np.where(moves, np.clip(q, low, high), case.at)])


def _followed(case: Case, way: Array) -> Motion | None:
    """The path, or the straight line of the end effector to the goal, followed from the end of a way; None if it is lost."""
    arm, moves = case.degraded.limited, case.degraded.moves
    solver, low, high = row_solver(arm, case.rows), *finite_limits(arm)
    if case.path is not None:
        path = case.path
    else:
        assert case.goal is not None
        path = line(arm.forward_kinematics(way[-1]), case.goal)
    count = max(int(np.ceil(path.length / _SPACING)), 20)
    share = np.linspace(0, 1, count + 1)
    tolerance = np.where(np.array(solver.rows.units) == "m", NEAR, TURN) * _AIM
    kept, q, along = np.ones((1, solver.rows.m)), way[-1], [way[-1]]
    for pose in path.pose(share[1:]):
        for _ in range(_NEWTON):
            new = solver.run(q[None], pose[None], kept, moves, 1)[0]
            new = np.where(moves, np.clip(q + np.clip(new - q, -_STEP, _STEP), low, high), q)
            moved, q = np.abs(new - q).max(), new
            if (np.abs(solver.errors(q[None], pose[None])[0]) <= tolerance).all() or moved < 1e-9:
                break
        along.append(q)
    missed = np.abs(solver.errors(q[None], path.pose(1.0)[None])[0])
    if (missed > 10 * tolerance).any():
        return None
    return Motion(np.concatenate([way[:-1], along]), first=len(way) - 1, share=share if case.path is not None else np.zeros(0))


def _one_goal(case: Case, clearance: Clearance | None, rng: Rng) -> tuple[Space, Metric, Array] | None:
    """A clear configuration (n,) of the goal, and the space it lies in."""
    arm, moves = case.degraded.limited, case.degraded.moves
    space = Space(arm, moves, clearance, 0.0, case.at[None])
    metric = Metric.of(arm, "travel", None, moves)
    assert case.goal is not None
    goals = configurations_of(row_solver(arm, case.rows), space, metric, case.goal, case.at, STARTS, rng)
    return (space, metric, goals[0]) if len(goals) else None


def _rrt_connect(case: Case, clearance: Clearance | None, limit: Limit, rng: Rng) -> Attempt:
    """Two trees to one configuration of the goal, every piece proved clear: the trees of ours with nothing around them."""
    del limit  # of one search; it is bounded by its rounds
    found = _one_goal(case, clearance, rng)
    if found is None:
        return Attempt("undecided")
    space, metric, goal = found
    route = find_route(space, metric, case.at, goal[None], 1, rng)
    return Attempt("undecided") if route is None else Attempt("solved", Motion(route.q, share=np.zeros(0)))


def _ompl(case: Case, clearance: Clearance | None, limit: Limit, rng: Rng) -> Attempt:
    """OMPL's RRT-Connect to the same configuration, its validity our bound, at its own resolution of 1 % of the box."""
    from ompl import base, geometric, util

    found = _one_goal(case, clearance, rng)
    if found is None:
        return Attempt("undecided")
    space, _, goal = found
    moves = np.flatnonzero(space.free)
    util.setLogLevel(util.LOG_ERROR)
    states = base.RealVectorStateSpace(len(moves))
    bounds = base.RealVectorBounds(len(moves))
    for k, joint in enumerate(moves):
        bounds.setLow(k, float(space.low[joint]))
        bounds.setHigh(k, float(space.high[joint]))
    states.setBounds(bounds)
    setup = geometric.SimpleSetup(states)

    def whole(state: object) -> Array:
        q = case.at.copy()
        q[moves] = [state[k] for k in range(len(moves))]  # type: ignore[index]
        return q

    setup.setStateValidityChecker(lambda state: bool(space.clear(whole(state)[None])[0]))
    ends = [states.allocState() for _ in range(2)]
    for state, q in zip(ends, (case.at, goal), strict=True):
        for k, joint in enumerate(moves):
            state[k] = float(q[joint])
    setup.setStartAndGoalStates(*ends)
    setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
    setup.solve(limit.seconds)
    if not setup.haveExactSolutionPath():
        return Attempt("undecided")
    q = np.stack([whole(state) for state in setup.getSolutionPath().getStates()])
    return Attempt("solved", Motion(q, share=np.zeros(0)))


Method = Callable[[Case, Clearance | None, Limit, Rng], Attempt]
METHODS: dict[str, Method] = {
    "recover": _recover,
    "differential-ik": _differential,
    "differential-ik-8-starts": _with_restarts,
    "rrt-connect": _rrt_connect,
    "ompl-rrt-connect": _ompl,
}
ROUTES = ("rrt-connect", "ompl-rrt-connect")  # those that reach a pose and keep no rows on the way


def usable(name: str, task: str) -> bool:
    """Whether a method can be asked for a task at all."""
    return name not in ROUTES or task.startswith("reach")


def require(name: str) -> None:
    """Raise :class:`HoldfastError` where a method needs a package that is not installed."""
    if name == "ompl-rrt-connect" and find_spec("ompl") is None:
        raise HoldfastError("method 'ompl-rrt-connect' needs OMPL, which is not installed; install it with: pip install ompl")
