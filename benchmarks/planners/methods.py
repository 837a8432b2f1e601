"""Planners that the suite compares, each from a case to a motion: those of holdfast and standard ones."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np
from benchmarks.planners.cases import BenchmarkCase
from benchmarks.planners.verdicts import (
    ORIENTATION_TOLERANCE_RAD,
    POSITION_TOLERANCE_M,
    BenchmarkMotion,
    find_violation,
)

from holdfast.core.errors import HoldfastError
from holdfast.core.typing import FloatArray
from holdfast.kinematics.paths import line
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.collision import Clearance
from holdfast.response.recovery import recover
from holdfast.response.recovery.goals import PoseSearch, find_goal_configurations
from holdfast.response.recovery.recovery import Answer
from holdfast.response.recovery.routes import find_route
from holdfast.response.recovery.space import FreeSpace, JointMetric
from holdfast.response.recovery.task_rows import make_row_solver

Rng = np.random.Generator

GOAL_SEARCH_STARTS = 256  # of the search for a configuration of the goal, of every planner that needs one
_RESTART_COUNT = 8
_POSE_SPACING = 0.01  # m or rad of the end effector between poses that differential inverse kinematics follows
_MAX_JOINT_STEP = 0.1  # rad or m that a joint may move between two of them
_TRACKING_NEWTON_STEPS = 10  # steps at each of them
_TOLERANCE_FRACTION = 0.1  # of the tolerances that count, which differential inverse kinematics aims at


@dataclass(frozen=True, eq=False)
class PlanningResult:
    """Result of a planner for a case.

    Attributes:
        verdict: What the planner says.
        motion: What it gives, if anything.
        within: What it proves holds for all that the judge accepts, too.
    """

    verdict: Answer
    motion: BenchmarkMotion | None = None
    within: bool = False


@dataclass(frozen=True)
class TimeLimit:
    """Time limit of one case.

    Attributes:
        seconds: From when it was made.
        started_at: When that was, s.
    """

    seconds: float
    started_at: float

    @classmethod
    def start(cls, seconds: float) -> TimeLimit:
        """Return a limit that starts now."""
        return cls(seconds, time.perf_counter())

    @property
    def is_reached(self) -> bool:
        """True once the time limit is reached."""
        return time.perf_counter() - self.started_at > self.seconds


def _plan_recovery(case: BenchmarkCase, clearance: Clearance | None, limit: TimeLimit, rng: Rng) -> PlanningResult:
    """Plan with :func:`holdfast.recover`."""
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
        starts=GOAL_SEARCH_STARTS,
        time_limit=limit.seconds,
        tolerance=(POSITION_TOLERANCE_M, ORIENTATION_TOLERANCE_RAD),
        seed=int(rng.integers(2**31)),
    )
    if not answer.ok:
        return PlanningResult(answer.verdict.answer, within=answer.proved_within)
    path_leg = next((candidate for candidate in answer.legs if candidate.name == "along the path"), None)
    path_fractions = np.zeros(0) if path_leg is None or answer.rest is None else answer.rest.share
    return PlanningResult(
        answer.verdict.answer, BenchmarkMotion(answer.q, first=0 if path_leg is None else path_leg.first, share=path_fractions)
    )


def _plan_differential(
    case: BenchmarkCase, clearance: Clearance | None, limit: TimeLimit, rng: Rng, restarts: int = 1
) -> PlanningResult:
    """Follow poses with Newton's method within the joint limits, first from the start, then from other configurations."""
    for approach in _approaches(case, restarts, rng):
        if limit.is_reached:
            break
        motion = _follow_path(case, approach)
        if motion is not None and not find_violation(case, motion, clearance):
            return PlanningResult("solved", motion)
    return PlanningResult("undecided")


def _plan_with_restarts(case: BenchmarkCase, clearance: Clearance | None, limit: TimeLimit, rng: Rng) -> PlanningResult:
    return _plan_differential(case, clearance, limit, rng, _RESTART_COUNT)


def _approaches(case: BenchmarkCase, restarts: int, rng: Rng) -> Iterator[FloatArray]:
    """Yield approaches (K, n) to the beginning of the path: the start alone, or a straight motion from it to another
    configuration.
    """
    yield case.at[None]
    arm, is_movable = case.degraded.limited, case.degraded.moves
    solver = make_row_solver(arm, case.rows)
    lower, upper = sampling_limits(arm)
    for _ in range(restarts - 1):
        q = np.where(is_movable, rng.uniform(lower, upper), case.at)[None]
        if case.path is not None:
            q = solver.solve(q, case.path.pose(0.0)[None], np.ones((1, solver.rows.m)), is_movable)
        yield np.concatenate([case.at[None], np.where(is_movable, np.clip(q, lower, upper), case.at)])


def _follow_path(case: BenchmarkCase, approach: FloatArray) -> BenchmarkMotion | None:
    """Follow the path, or the straight line of the end effector to the goal, from the end of an approach; None if
    it is lost.
    """
    arm, is_movable = case.degraded.limited, case.degraded.moves
    solver, lower, upper = make_row_solver(arm, case.rows), *sampling_limits(arm)
    if case.path is not None:
        path = case.path
    else:
        assert case.goal is not None
        path = line(arm.forward_kinematics(approach[-1]), case.goal)
    pose_count = max(int(np.ceil(path.length / _POSE_SPACING)), 20)
    path_fractions = np.linspace(0, 1, pose_count + 1)
    tolerance = (
        np.where(np.array(solver.rows.units) == "m", POSITION_TOLERANCE_M, ORIENTATION_TOLERANCE_RAD) * _TOLERANCE_FRACTION
    )
    weights, q, configurations = np.ones((1, solver.rows.m)), approach[-1], [approach[-1]]
    for pose in path.pose(path_fractions[1:]):
        for _ in range(_TRACKING_NEWTON_STEPS):
            next_q = solver.solve(q[None], pose[None], weights, is_movable, 1)[0]
            next_q = np.where(is_movable, np.clip(q + np.clip(next_q - q, -_MAX_JOINT_STEP, _MAX_JOINT_STEP), lower, upper), q)
            step_size, q = np.abs(next_q - q).max(), next_q
            if (np.abs(solver.compute_errors(q[None], pose[None])[0]) <= tolerance).all() or step_size < 1e-9:
                break
        configurations.append(q)
    final_error = np.abs(solver.compute_errors(q[None], path.pose(1.0)[None])[0])
    if (final_error > 10 * tolerance).any():
        return None
    return BenchmarkMotion(
        np.concatenate([approach[:-1], configurations]),
        first=len(approach) - 1,
        share=path_fractions if case.path is not None else np.zeros(0),
    )


def _find_goal(case: BenchmarkCase, clearance: Clearance | None, rng: Rng) -> tuple[FreeSpace, JointMetric, FloatArray] | None:
    """Return a collision-free configuration (n,) of the goal, and its configuration space."""
    arm, is_movable = case.degraded.limited, case.degraded.moves
    space = FreeSpace(arm, is_movable, clearance, 0.0, case.at[None])
    metric = JointMetric.for_arm(arm, "travel", None, is_movable)
    assert case.goal is not None
    search = PoseSearch(make_row_solver(arm, case.rows), space, metric)
    goals = find_goal_configurations(search, case.goal, case.at, GOAL_SEARCH_STARTS, rng)
    return (space, metric, goals[0]) if len(goals) else None


def _plan_rrt_connect(case: BenchmarkCase, clearance: Clearance | None, limit: TimeLimit, rng: Rng) -> PlanningResult:
    """Plan with two trees to one configuration of the goal, every segment proved collision-free, with the trees of holdfast
    alone.
    """
    del limit  # of one search; it is bounded by its rounds
    goal_search = _find_goal(case, clearance, rng)
    if goal_search is None:
        return PlanningResult("undecided")
    space, metric, goal = goal_search
    route = find_route(space, metric, case.at, goal[None], 1, rng)
    return (
        PlanningResult("undecided") if route is None else PlanningResult("solved", BenchmarkMotion(route.q, share=np.zeros(0)))
    )


def _plan_ompl(case: BenchmarkCase, clearance: Clearance | None, limit: TimeLimit, rng: Rng) -> PlanningResult:
    """Plan with OMPL's RRT-Connect to the same configuration and with our bound as validity check, at its own resolution of 1 %
    of the box.
    """
    from ompl import base, geometric, util

    goal_search = _find_goal(case, clearance, rng)
    if goal_search is None:
        return PlanningResult("undecided")
    space, _, goal = goal_search
    movable_joints = np.flatnonzero(space.free)
    util.setLogLevel(util.LOG_ERROR)
    states = base.RealVectorStateSpace(len(movable_joints))
    bounds = base.RealVectorBounds(len(movable_joints))
    for index, joint in enumerate(movable_joints):
        bounds.setLow(index, float(space.low[joint]))
        bounds.setHigh(index, float(space.high[joint]))
    states.setBounds(bounds)
    setup = geometric.SimpleSetup(states)

    def full_configuration(state: object) -> FloatArray:
        q = case.at.copy()
        q[movable_joints] = [state[index] for index in range(len(movable_joints))]  # type: ignore[index]
        return q

    setup.setStateValidityChecker(lambda state: bool(space.are_valid(full_configuration(state)[None])[0]))
    end_states = [states.allocState() for _ in range(2)]
    for state, q in zip(end_states, (case.at, goal), strict=True):
        for index, joint in enumerate(movable_joints):
            state[index] = float(q[joint])
    setup.setStartAndGoalStates(*end_states)
    setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
    setup.solve(limit.seconds)
    if not setup.haveExactSolutionPath():
        return PlanningResult("undecided")
    q = np.stack([full_configuration(state) for state in setup.getSolutionPath().getStates()])
    return PlanningResult("solved", BenchmarkMotion(q, share=np.zeros(0)))


Method = Callable[[BenchmarkCase, Clearance | None, TimeLimit, Rng], PlanningResult]
PLANNERS_BY_NAME: dict[str, Method] = {
    "recover": _plan_recovery,
    "differential-ik": _plan_differential,
    "differential-ik-8-starts": _plan_with_restarts,
    "rrt-connect": _plan_rrt_connect,
    "ompl-rrt-connect": _plan_ompl,
}
POSE_PLANNERS = ("rrt-connect", "ompl-rrt-connect")  # those that reach a pose and keep no rows on the way


def is_applicable(name: str, task: str) -> bool:
    """Return whether a method can solve a task."""
    return name not in POSE_PLANNERS or task.startswith("reach")


def require_installed(name: str) -> None:
    """Raise :class:`HoldfastError` if a method needs a package that is not installed."""
    if name == "ompl-rrt-connect" and find_spec("ompl") is None:
        raise HoldfastError("method 'ompl-rrt-connect' needs OMPL, which is not installed; install it with: pip install ompl")
