"""A joint is known to be locked: what the arm can still do, and a route home."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import as_configurations
from holdfast.arm.model import Arm
from holdfast.arm.poses import check_poses
from holdfast.arm.task import Task, as_task, plane_normal
from holdfast.arm.tree import listed
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.sharper import sharpened
from holdfast.errors import InputError
from holdfast.failures import Degraded, Locked, degraded_at
from holdfast.notice import says
from holdfast.recovery.bounds import out_of_reach
from holdfast.recovery.continuation import RestOfPath, rest_of_path
from holdfast.recovery.goals import Relaxed, RowsGivenUp, configurations_of, rows_to_give_up, what_bars
from holdfast.recovery.recovery import Ending, Leg, Recovery
from holdfast.recovery.remainder import what_is_left
from holdfast.recovery.routes import Metric, MetricName, Route, Space, find_route
from holdfast.recovery.rows import RowSolver, row_solver
from holdfast.recovery.second_try import bolder
from holdfast.regions.region import Region
from holdfast.solvers import joint_space

if TYPE_CHECKING:
    from holdfast.paths.path import Path

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

SAME = 1e-6  # rad and m: a joint this near to its angle is there


@dataclass(frozen=True)
class _Goal:
    """What the end effector, or the arm, should reach.

    Attributes:
        text: For people.
        pose: (4, 4) of the end effector.
        q: (n,) the configuration, if that itself is the goal; else None.
        lost: Joints locked elsewhere than in that configuration, or None.
    """

    text: str
    pose: Array
    q: Array | None = None
    lost: RowsGivenUp | None = None


@checked
@says("planning the route")
def recover(
    arm: Arm,
    locked: Locked,
    at: ArrayLike,
    *,
    goal: ArrayLike | str | None = "home",
    task: str | Task | Sequence[str] | None = None,
    path: Path | None = None,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
    metric: MetricName = "travel",
    weights: ArrayLike | None = None,
    region: Region | None = None,
    samples: int = 1000,
    starts: int = 256,
    tries: int = 4,
    seed: int = 0,
) -> Recovery:
    """Find a route home for an arm of which it is known what is locked or degraded, and say what it can still do.

    The goal is first looked for as a whole: configurations that meet every row, within the limits, with the locks exactly where
    they are, and clear. The shortest motion found to any of them is returned. If none is found, sets of rows are given up,
    as few as possible; the motion then ends where the others are met, and ``ending`` says so.

    Args:
        arm: The arm.
        locked: ``{joint: value}``, joints by name or index from 0, values in rad or m; ``{joint: None}``, or the joints alone,
            for where ``at`` has them. Or a :class:`holdfast.Degraded`, which also has reduced ranges and speeds.
        at: (n,) where the arm is, rad and m.
        goal: (4, 4) pose of the end effector in the world, m; (n,) a configuration; the name of one of ``arm.states`` (a
            built-in arm's home, the states of an SRDF file, the keyframes of an MJCF file); ``"home"`` of an arm without a
            state of this name: all joints at 0, or at the limit nearest to it; None, with a path: where that ends. A
            configuration means all its joints, unless a task is given: then it means the end effector's pose there. Where a
            locked joint is elsewhere than a configuration asks, that joint is given up and the end effector's pose is aimed at.
        task: Rows of the end effector's pose that matter; if not given, the pose, or position for an arm that moves in a plane
            or for a path without orientations.
        path: The rest of a tool path, to be finished before going to the goal.
        clearance: Kept between links; None: capsules of an assumed radius, but not for an arm that moves in a plane; True:
            for that too; False: none.
        cell: Objects around the arm, or their file; every motion is proved clear of them, whatever ``clearance`` says.
        margin: m, smallest clearance; from an object beyond what the cell keeps from it.
        metric: Of the shortest route: ``travel`` (Euclidean length of the joints' motion, 1 m as 1 rad) or ``time`` (at the
            velocity limits).
        weights: (n,) of the joints in ``travel``; 1 if not given.
        region: Of targets for what is left of the workspace; else poses of random configurations of the healthy arm.
        samples: How many; 0: none.
        starts: Random starts of the search for configurations.
        tries: Searches for a route where straight lines are blocked.
        seed: The same seed gives the same result.

    Returns:
        A :class:`holdfast.Recovery`; ``ok`` only if everything that was asked for is met.

    Raises:
        InputError: An invalid joint, angle, goal or number.
        TaskError: An invalid task.
    """
    q, single = as_configurations(arm, at)
    if not single:
        raise InputError(f"at has shape {np.shape(at)}; give one configuration of {arm.n} numbers")
    for name, number, least in (("samples", samples, 0), ("starts", starts, 1), ("tries", tries, 0), ("seed", seed, 0)):
        if number < least:
            raise InputError(f"{name} is {number}; it must be {least} or more")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin}; it must be a finite number of metres")
    start = q[0]
    degraded = degraded_at(arm, locked, start)
    if degraded is None:
        raise InputError(f"no joint is locked; name at least one, for example locked=['{arm.joint_names[0]}']")
    free, limited = degraded.moves, degraded.limited
    if not free.any():
        raise InputError(f"all {arm.n} joints of '{arm.name}' are locked, so nothing can move; leave one free")
    kept = chosen_clearance(arm, clearance, cell)
    if margin and kept is None:
        raise InputError("margin has nothing to keep: no clearance is looked at; give one")
    length = Metric.of(limited, metric, None if weights is None else np.asarray(weights, dtype=np.float64), free)
    wanted = _task(arm, task, path)
    solver = row_solver(arm, wanted).within(limited)
    made = Recovery(
        degraded=degraded,
        at=start,
        goal="",
        goal_pose=None,
        task=wanted,
        q=np.zeros((0, arm.n)),
        starts=starts,
        metric=metric,
        unit=length.unit,
        clearance=kept,
        margin=margin,
        seed=seed,
    )
    standing = np.where(free, start, degraded.lo)
    aim = _goal(degraded, goal, task is not None, standing, sharpened(kept, margin) or kept, margin, path)
    made = replace(
        made, goal=aim.text if aim is not None else "the end of the tool path", goal_pose=None if aim is None else aim.pose
    )
    if samples:
        made = replace(made, left=what_is_left(solver, degraded, kept, margin, region, samples, seed))

    def attempt(kept: Clearance | None) -> Recovery:
        asked = replace(made, clearance=kept)
        trouble = _trouble(degraded, start, kept, margin)
        if trouble is not None:
            return replace(asked, ending=trouble[0], reason=trouble[1])
        space = Space(limited, free, kept, margin, np.stack([standing, *([] if aim is None or aim.q is None else [aim.q])]))
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))
        return _Search(asked, solver, space, length, tries, rng).run(standing, aim, path)

    return bolder(attempt(kept), attempt)


def home_of(arm: Arm) -> tuple[Array, str]:
    """Where home is, (n,), rad and m, and in words: the arm's state of this name, or every joint as near to 0 as it may be."""
    if "home" in arm.states:
        return arm.states["home"], "home"
    q = np.clip(np.zeros(arm.n), arm.lower, arm.upper)
    others = [name for name, value in zip(arm.joint_names, q, strict=True) if value]
    return q, "all joints at 0" + (f", {', '.join(others)} at the limit nearest to it" if others else "")


# ---- what was asked ------------------------------------------------------------------------------------------------------


def _task(arm: Arm, task: str | Task | Sequence[str] | None, path: Path | None) -> Task:
    if task is not None:
        return as_task(arm, task)
    flat = plane_normal(arm) is not None
    whole = path is None or path.oriented
    return as_task(arm, "planar" if flat else "pose" if whole else "position")


def _goal(
    degraded: Degraded,
    goal: ArrayLike | str | None,
    by_hand: bool,
    standing: Array,
    clearance: Clearance | None,
    margin: float,
    path: Path | None,
) -> _Goal | None:
    arm, free = degraded.arm, degraded.moves
    if goal is None:
        if path is None:
            raise InputError("there is neither a goal nor a path; give goal='home', a pose, a configuration, or a path")
        return None
    if isinstance(goal, str):
        if goal != "home" and goal not in arm.states:
            known = listed(list({"home": 0, **arm.states}))
            raise InputError(f"goal '{goal}' is not known; give {known}, a pose (4, 4) or a configuration ({arm.n},)")
        q, text = (arm.states[goal], goal) if goal in arm.states else home_of(arm)
    else:
        given = np.asarray(goal, dtype=np.float64)
        if given.ndim == 2 and given.shape == (4, 4):
            if not np.isfinite(given).all():
                raise InputError("goal holds NaN or infinity; give a pose of finite numbers")
            return _Goal("a pose of the end effector", check_poses(given)[0])
        if given.shape != (arm.n,) or not np.isfinite(given).all():
            raise InputError(
                f"goal has shape {given.shape}; give 'home', a pose (4, 4), or a configuration of {arm.n} finite numbers"
            )
        text, q = "a configuration", given
    beyond = [arm.joint_names[k] for k in np.flatnonzero((q < arm.lower) | (q > arm.upper))]
    if beyond:
        raise InputError(f"goal: joint '{beyond[0]}' is outside its limits there; give a configuration within them")
    pose = arm.forward_kinematics(q)
    if by_hand:
        return _Goal(f"the end effector where it is at {text}", pose)
    if clearance is not None and float(clearance.room(q)) < margin:
        raise InputError(
            f"goal: at that configuration the arm {clearance.too_close(margin, q)}; give a clear one, or no clearance"
        )
    away = np.abs(joint_space.difference(arm, q, np.where(free, np.clip(q, degraded.lo, degraded.hi), standing)))
    lost = np.flatnonzero(np.where(free, away > 0, away > SAME))
    if not lost.size:
        return _Goal(text, pose, np.where(free, q, standing))
    units = ["m" if arm.prismatic[k] else "rad" for k in lost]
    rows = RowsGivenUp(tuple(arm.joint_names[k] for k in lost), tuple(away[lost].tolist()), tuple(units))
    return _Goal(text, pose, None, rows)


def _trouble(degraded: Degraded, at: Array, clearance: Clearance | None, margin: float) -> tuple[Ending, str] | None:
    """Why the arm may not even start, or None."""
    arm, value = degraded.arm, degraded.lo
    for k in np.flatnonzero(~degraded.moves & (np.abs(at - value) > SAME)):
        return Ending.LOCK_ELSEWHERE, (
            f"{arm.joint_names[k]} is said to be locked at {value[k]:.6g} and is at {at[k]:.6g} {arm.joints[k].unit}; "
            "give the angle at which it is, or leave the angle out"
        )
    for joint, x in zip(degraded.limited.joints, at, strict=True):
        if not joint.lower <= x <= joint.upper:
            reduced = joint.name in degraded.ranges
            return Ending.START_OUTSIDE_LIMITS, (
                f"{joint.name} is at {x:.6g} {joint.unit}, its limits are {'now ' * reduced}{joint.lower:.6g} to "
                f"{joint.upper:.6g}; if it can move there, widen {'its range' if reduced else 'the limits of the arm'}"
            )
    if clearance is not None and clearance.pair_names and float(clearance.room(at)) < margin:
        own = int(clearance.closest_pair(at)) < len(clearance.pairs)
        advice = "or no clearance" if own else "or move the object"
        return Ending.START_TOO_CLOSE, f"the arm {clearance.too_close(margin, at)}; give the arm's real capsules, {advice}"
    return None


# ---- the search ----------------------------------------------------------------------------------------------------------


class _Search:
    """One recovery, step by step."""

    def __init__(
        self, made: Recovery, solver: RowSolver, space: Space, metric: Metric, tries: int, rng: np.random.Generator
    ) -> None:
        self.made, self.solver, self.space, self.metric, self.tries, self.rng = made, solver, space, metric, tries, rng
        self._q: list[Array] = []
        self._legs: list[Leg] = []

    def run(self, start: Array, aim: _Goal | None, path: Path | None) -> Recovery:
        here = start
        rest: RestOfPath | None = None
        if path is not None:
            rest = self._finish(here, path)
            here = self._q[-1][-1] if self._q else start
            self.made = replace(self.made, rest=rest)
        ended = self.made if aim is None else self._go(here, aim)
        if rest is not None and ended.ending in (Ending.HOME, Ending.HOME_WITH_ROWS_GIVEN_UP) and not rest.finished:
            lost = rest.given_up if len(rest.q) else None
            if lost is None:
                ended = replace(ended, ending=Ending.PATH_UNFINISHED)
            else:
                both = lost if ended.given_up is None else lost + ended.given_up
                ended = replace(ended, ending=Ending.HOME_WITH_ROWS_GIVEN_UP, given_up=both)
        q = np.concatenate(self._q) if self._q else self.made.q
        return replace(ended, q=q, legs=tuple(self._legs))

    def _add(self, name: str, q: Array, lower_bound: float, straight: bool) -> None:
        length = float(self.metric.along(q)[-1])
        first = max(sum(len(x) for x in self._q) - 1, 0)
        self._legs.append(
            Leg(name=name, first=first, last=first + len(q) - 1, length=length, lower_bound=lower_bound, straight=straight)
        )
        self._q.append(q if not self._q else q[1:])

    def _finish(self, here: Array, path: Path) -> RestOfPath:
        """Follow the path if that can be done; the first motion that can be reached, the shortest first."""
        rest, motions = rest_of_path(self.solver, self.space, self.metric, path, here, self.made.starts, self.rng)
        if not motions:
            return rest
        route = self._route(here, np.stack([m[0] for m in motions]))
        if route is None:
            return replace(rest, q=np.zeros((0, self.made.arm.n)), given_up=None, cut_off=True)
        motion = motions[route.goal]
        motion = motion + (route.q[-1] - motion[0])  # whole turns
        if route.length > SAME:
            self._add("to the path", route.q, route.lower_bound, route.straight)
        else:
            motion[0] = here
        self._add("along the path", motion, float(self.metric.length(motion[-1] - motion[0])), False)
        return replace(rest, q=motion)

    def _route(self, here: Array, goals: Array) -> Route | None:
        return find_route(self.space, self.metric, here, goals, self.tries, self.rng)

    def _go(self, here: Array, aim: _Goal) -> Recovery:
        """To the goal, or as near as it gets."""
        made = self.made
        if aim.q is not None:
            goals = aim.q[None]
        else:
            goals = configurations_of(self.solver, self.space, self.metric, aim.pose, here, made.starts, self.rng)
        made = replace(made, found=len(goals))
        ending = Ending.HOME if aim.lost is None else Ending.HOME_WITH_ROWS_GIVEN_UP
        reasons = []
        if aim.lost is not None:
            made = replace(made, given_up=aim.lost)
            reasons.append(
                f"{' and '.join(aim.lost.names)} cannot be where {aim.text} has it; the end effector's pose there is aimed at"
            )
        if len(goals):
            route = self._route(here, goals)
            if route is not None:
                self._add("to the goal", route.q, route.lower_bound, route.straight)
                return replace(made, ending=ending, reason="; ".join(reasons))
            reasons.append(
                f"{len(goals)} configurations of the goal were found and {self.tries} searches led to none of them"
                f"{self._in_the_way(here, goals[0])}"
            )
            return replace(made, ending=Ending.NO_ROUTE_FOUND, given_up=None, reason="; ".join(reasons))
        proof = self._proof(here, aim.pose)
        pair = "" if proof else what_bars(self.solver, self.space, aim.pose, here, np.random.default_rng(made.seed))
        found = "no clear configuration" if pair else "no configuration"
        bars = f"; what is most often in the way where it is met: {pair}" if pair else ""
        reasons.append(proof or f"{found} of the goal was found in {made.starts} starts, which proves nothing{bars}")
        made = replace(made, proof=proof)
        choices = rows_to_give_up(self.solver, self.space, self.metric, aim.pose, here, self.rng)
        for choice in choices:
            route = self._route(here, choice.q)
            if route is not None:
                self._add("to the goal", route.q, route.lower_bound, route.straight)
                return self._relaxed(made, aim, choice, choices, reasons)
        nothing = Ending.PROVED_UNREACHABLE if proof else Ending.NOTHING_FOUND
        if choices:
            reasons.append("rows could be given up, but no motion was found to a configuration without them")
        everything = tuple(c.rows for c in choices)
        return replace(made, ending=nothing, given_up=None, choices=everything, reason="; ".join(reasons))

    def _in_the_way(self, here: Array, goal: Array) -> str:
        """What a straight line to a goal meets, if it meets anything."""
        pair = self.space.nearest(here + np.linspace(0, 1, 201)[:, None] * self.space.difference(goal, here))
        return f"; in the way of the straight line: {pair}" if pair else ""

    def _relaxed(self, made: Recovery, aim: _Goal, choice: Relaxed, choices: list[Relaxed], reasons: list[str]) -> Recovery:
        rows = choice.rows if aim.lost is None else aim.lost + choice.rows
        return replace(
            made,
            ending=Ending.HOME_WITH_ROWS_GIVEN_UP,
            given_up=rows,
            choices=tuple(c.rows for c in choices),
            reason="; ".join(reasons),
        )

    def _proof(self, at: Array, pose: Array) -> str | None:
        """That the pose is out of reach, if its position counts and the bound says so."""
        rows, arm = self.solver.rows, self.made.arm
        linear = rows.matrix[np.abs(rows.matrix[:, 3:]).max(axis=1) == 0, :3]
        rank = int(np.linalg.matrix_rank(linear)) if len(linear) else 0
        normal = plane_normal(arm)
        if rank == 3:
            normal = None
        elif rank != 2 or normal is None or rows.linear != "base" or np.abs(linear @ normal).max() > 1e-9:
            return None
        return out_of_reach(self.space.arm, self.space.free, at, pose, rows.m == 6, normal)
