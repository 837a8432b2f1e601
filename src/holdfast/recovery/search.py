"""A joint is known to be locked: what the arm can still do, and a route home."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from time import monotonic
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import as_configurations
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.certainty import unknown_shape
from holdfast.clearance.exact.sharper import sharpened
from holdfast.errors import InputError
from holdfast.failures import Locked, degraded_at
from holdfast.keep.labels import KeepLike, all_kept
from holdfast.notice import says
from holdfast.recovery.completion import completed
from holdfast.recovery.continuation import RestOfPath, along, continue_unfinished_path, refined, rest_of_path, without_rows
from holdfast.recovery.goals import configurations_of, rows_to_give_up, what_bars
from holdfast.recovery.layers import shorter
from holdfast.recovery.proofs.of_path import proved_of_path
from holdfast.recovery.proofs.reach import ANY_ORIENTATION, Tolerance, every_clear, nothing_within, unreachable
from holdfast.recovery.proofs.separation import separated
from holdfast.recovery.question import SAME, Goal, broken_by, check_numbers, doubtful_contact, goal_of, task_of, trouble_of
from holdfast.recovery.recovery import Ending, Leg, ProofKind, Recovery
from holdfast.recovery.remainder import what_is_left
from holdfast.recovery.routes import Route, find_route
from holdfast.recovery.rows import RowSolver, row_solver
from holdfast.recovery.second_try import bolder
from holdfast.recovery.space import Metric, MetricName, Space
from holdfast.recovery.timing.limits import AccelerationsLike, limits_by_joint
from holdfast.regions.region import Region

if TYPE_CHECKING:
    from holdfast.paths.path import Path

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@checked
@says("planning the route")
def recover(
    arm: Arm,
    locked: Locked,
    at: ArrayLike,
    *,
    goal: ArrayLike | str | None = "home",
    within: float | None = None,
    task: str | Task | Sequence[str] | None = None,
    path: Path | None = None,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
    keep: KeepLike | None = None,
    metric: MetricName = "travel",
    weights: ArrayLike | None = None,
    region: Region | None = None,
    samples: int = 1000,
    starts: int = 256,
    tries: int = 4,
    time_limit: float | None = None,
    tolerance: Tolerance | None = None,
    accelerations: AccelerationsLike | None = None,
    period: float = 0.01,
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
        goal: (4, 4) pose of the end effector in the world, m, or (G, 4, 4), any of them; (n,) a configuration; the name of one
            of ``arm.states`` (a built-in arm's home, the states of an SRDF file, the keyframes of an MJCF file); ``"home"`` of
            an arm without a state of this name: all joints at 0, or at the limit nearest to it; None, with a path: where that
            ends. A configuration means all its joints, unless a task is given: then it means the end effector's pose there.
            Where a locked joint is elsewhere than a configuration asks, that joint is given up and the pose is aimed at.
        within: Angle in rad by which the tool's z axis may be off that of the goal's pose, any turn about the axis allowed, in
            place of the rows of orientation. A configuration then means its pose. Proofs hold for all orientations.
        task: Rows of the end effector's pose that matter; if not given, the pose, or position for an arm that moves in a plane
            or for a path without orientations.
        path: The rest of a tool path, to be finished before going to the goal.
        clearance: Kept between links; None: capsules of an assumed radius, but not for an arm that moves in a plane; True:
            for that too; False: none.
        cell: Objects around the arm, or their file; every motion is proved clear of them, whatever ``clearance`` says.
        margin: m, smallest clearance; from an object beyond what the cell keeps from it.
        keep: What the tool keeps along the whole motion: :func:`holdfast.keep.upright`, :func:`holdfast.keep.rail`,
            :func:`holdfast.keep.plane`, a label of one (``"upright:10deg"``, see :func:`holdfast.keep.by_label`), or several.
        metric: Of the shortest route: ``travel`` (Euclidean length of the joints' motion, 1 m as 1 rad) or ``time`` (at the
            velocity limits).
        weights: (n,) of the joints in ``travel``; 1 if not given.
        region: Of targets for what is left of the workspace; else poses of random configurations of the healthy arm.
        samples: How many; 0: none.
        starts: Random starts of the search for configurations.
        tries: Searches for a route where straight lines are blocked; once a quarter found none, a proof is looked for first.
        time_limit: s after which nothing more is searched for; what is left of the workspace does not count. With one, the same
            seed need not give the same result.
        tolerance: m and rad by which each row of the goal or the tool path may be missed without harm. What is proved to be
            impossible is then proved with that too if it can be, and ``proved_within`` says so; motions do not use it.
        accelerations: Limits, rad/s^2 and m/s^2, within which the motion found is timed as ``timed`` of the result: a number, n
            numbers, or one by joint. Its corners are rounded where that is proved to keep limits, rows and clearance; along a
            tool path by at most half a millimetre and a quarter of a degree; elsewhere the arm stops there.
        period: s between the rows of the timed motion.
        seed: The same seed gives the same result.

    Returns:
        A :class:`holdfast.Recovery`; ``ok`` only if everything that was asked for is met, which other code has verified. Its
        ``verdict`` says whether it can be done: solved, proved or argued infeasible, or undecided.

    Raises:
        InputError: An invalid joint, angle, goal or number.
        TaskError: An invalid task.
    """
    q, single = as_configurations(arm, at)
    if not single:
        raise InputError(f"at has shape {np.shape(at)}; give one configuration of {arm.n} numbers")
    counts = {"samples": (samples, 0), "starts": (starts, 1), "tries": (tries, 0), "seed": (seed, 0)}
    check_numbers(counts, time_limit=time_limit, tolerance=tolerance, period=period, margin=margin)
    start = q[0]
    degraded = degraded_at(arm, locked, start)
    if degraded is None:
        raise InputError(f"no joint is locked; name at least one, for example locked=['{arm.joint_names[0]}']")
    free, limited = degraded.moves, degraded.limited
    if not free.any():
        raise InputError(f"all {arm.n} joints of '{arm.name}' are locked, so nothing can move; leave one free")
    most = None if accelerations is None else limits_by_joint(arm, accelerations, free)
    kept = chosen_clearance(arm, clearance, cell)
    if margin and kept is None:
        raise InputError("margin has nothing to keep: no clearance is looked at; give one")
    length = Metric.of(limited, metric, None if weights is None else np.asarray(weights, dtype=np.float64), free)
    wanted = task_of(arm, task, path, within)
    solver = row_solver(arm, wanted, within).within(limited)
    made = Recovery(
        degraded=degraded,
        at=start,
        goal="",
        goal_pose=None,
        task=wanted,
        within=within,
        q=np.zeros((0, arm.n)),
        starts=starts,
        metric=metric,
        unit=length.unit,
        clearance=kept,
        margin=margin,
        keep=all_kept(keep, arm.forward_kinematics(start)),
        tolerance=None if tolerance is None else (float(tolerance[0]), float(tolerance[1])),
        seed=seed,
    )
    standing = np.where(free, start, degraded.lo)
    aim = goal_of(degraded, goal, within, task is not None, standing, sharpened(kept, margin) or kept, margin, path)
    made = replace(
        made, goal=aim.text if aim is not None else "the end of the tool path", goal_pose=None if aim is None else aim.poses[0]
    )
    if samples:
        made = replace(made, left=what_is_left(solver, degraded, kept, margin, region, samples, seed))

    def attempt(kept: Clearance | None) -> Recovery:
        asked = replace(made, clearance=kept)
        trouble = trouble_of(degraded, start, kept, margin, made.keep)
        if trouble is not None:
            known = {"proof_kind": "start"} if trouble.certain else {"unknown": trouble.reason}
            return replace(asked, ending=trouble.ending, reason=trouble.reason, **known)  # type: ignore[arg-type]
        around = np.stack([standing, *([] if aim is None or aim.q is None else [aim.q])])
        space = Space(limited, free, kept, margin, around, keep=made.keep)
        if time_limit is not None:
            space.stop_after(time_limit - (monotonic() - began))
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))
        return _Search(asked, solver, space, length, tries, rng, pace=None if most is None else (most, period)).run(
            standing, aim, path
        )

    began = monotonic()
    return bolder(attempt(kept), attempt)


# ---- the search ----------------------------------------------------------------------------------------------------------


class _Search:
    """One recovery, step by step."""

    def __init__(
        self,
        made: Recovery,
        solver: RowSolver,
        space: Space,
        metric: Metric,
        tries: int,
        rng: np.random.Generator,
        pace: tuple[Array, float] | None,
    ) -> None:
        self._pace = pace
        self._few = max(1, tries // 4)  # of 385 searches that found a route in one of six, all did in the first
        self.made, self.solver, self.space, self.metric, self.tries, self.rng = made, solver, space, metric, tries, rng
        self._q: list[Array] = []
        self._legs: list[Leg] = []
        self._stopped = ""

    def run(self, start: Array, aim: Goal | None, path: Path | None) -> Recovery:
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
        ended = replace(ended, q=q, legs=tuple(self._legs), stopped=self._stopped)
        return completed(ended, self.space, self.solver.rows, aim, path, self._pace) if len(q) else ended

    def _look(self, doing: str) -> None:
        """The time limit may have been spent in what was just done."""
        if self.space.spent and not self._stopped:
            self._stopped = doing

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
        self._look("following the tool path")
        if not rest.finished:
            rest, motions = self._extend_path(rest, path, here)
        if not rest.finished:
            self.made = proved_of_path(self.made, rest, path, solver=self.solver, space=self.space)
            shape, lost = unknown_shape(self.space.clearance), rest.first_lost
            first = path.pose(rest.share[:1] if lost is None else np.array([lost]))
            if shape and (lost is None or what_bars(self.solver, self.space, first, here, self.made.seed)):
                self.made = replace(self.made, unknown=f"{rest.why}; {shape}")
            rest, motions = without_rows(rest, self.solver, self.space, path, here, self.rng)
            self._look("looking for rows of the tool path to give up")
        if not motions:
            return rest
        reached = self._reach(here, path, rest, motions)
        if not reached.cut_off or rest.given_up is not None:
            return reached
        rest, motions = self._extend_path(reached, path, here)
        return self._reach(here, path, rest, motions) if motions else rest

    def _extend_path(self, rest: RestOfPath, path: Path, here: Array) -> tuple[RestOfPath, list[Array]]:
        """Extend the motion along the path as far as possible; also return the motion if it gets to the end."""
        return continue_unfinished_path(rest, self.solver, self.space, self.metric, path, here, self.made.starts, self.rng)

    def _reach(self, here: Array, path: Path, rest: RestOfPath, motions: list[Array]) -> RestOfPath:
        """The first of the motions along the path that can be reached, and is near it all the way."""
        route, proof = self._way(here, np.stack([m[0] for m in motions]), path.pose(rest.share[:1]))
        self._look("looking for a route to the tool path")
        if route is None:
            if proof is not None and not self.made.proof_kind:
                why = f"at the beginning of the tool path: {proof[0]}"
                self.made = replace(self.made, proof=why, proof_kind="disconnected", proved_within=proof[1])
            return replace(rest, q=np.zeros((0, self.made.arm.n)), given_up=None, cut_off=True)
        motion = motions[route.goal]
        if rest.graph:
            motion = shorter(self.solver, self.space, self.metric, path.pose(rest.share), motion)
        if rest.given_up is None:
            finer = refined(rest, self.solver, self.space, path, motion)
            if finer is None and len(motions) > 1 and not self.space.spent:
                return self._reach(here, path, rest, motions[: route.goal] + motions[route.goal + 1 :])
            rest, motion = finer or (along(rest, self.solver, path, motion), motion)
        motion = motion + (route.q[-1] - motion[0])  # whole turns
        if route.length > SAME:
            self._add("to the path", route.q, route.lower_bound, route.straight)
        else:
            motion[0] = here
        self._add("along the path", motion, float(self.metric.length(motion[-1] - motion[0])), False)
        return replace(rest, q=motion)

    def _route(self, here: Array, goals: Array, again: int = 0) -> Route | None:
        tries, vain = (again, None) if again else (self.tries, self._few)
        return find_route(self.space, self.metric, here, goals, tries, self.rng, vain=vain)

    def _way(
        self, here: Array, goals: Array, poses: Array, q: Array | None = None
    ) -> tuple[Route | None, tuple[str, bool] | None]:
        """A route, or a proof that there is none; that is looked for after the first searches in vain, before the others."""
        route = self._route(here, goals)
        if route is not None:
            return route, None
        proof = separated(self.made, self.solver.rows, self.space, start=here, known=goals, poses=poses, q=q)
        if proof is None and self.space.manifold is None and self.tries > self._few:
            route = self._route(here, goals, self.tries - self._few)
        return route, proof

    def _go(self, here: Array, aim: Goal) -> Recovery:
        """To the goal, or as near as it gets."""
        made = self.made
        broken = [broken_by(made.keep, self.solver.rows if aim.q is None else None, pose) for pose in aim.poses]
        if all(broken):
            why = broken[0]
            return replace(made, ending=Ending.PROVED_UNREACHABLE, proof=why, proof_kind="rows kept", reason=why)
        seen = self.space.clearance
        if aim.q is not None and seen is not None and float(seen.room(aim.q)) < made.margin:
            why = f"at the goal {doubtful_contact(seen, aim.q, made.margin)}"
            return replace(made, ending=Ending.NOTHING_FOUND, reason=why, unknown=why)
        if aim.q is not None:
            goals, owner = aim.q[None], np.zeros(1, dtype=np.int64)
        else:
            each = [
                configurations_of(self.solver, self.space, self.metric, pose, here, made.starts, self.rng) for pose in aim.poses
            ]
            goals, owner = np.concatenate(each), np.repeat(np.arange(len(each)), [len(x) for x in each])
        none: list[str | None] = []
        if not len(goals):
            goals, owner, none = every_clear(made, self.solver, self.space, aim.poses)
        self._look("looking for configurations of the goal")
        made = replace(made, found=len(goals))
        ending = Ending.HOME if aim.lost is None else Ending.HOME_WITH_ROWS_GIVEN_UP
        reasons = []
        if aim.lost is not None:
            names = " and ".join(aim.lost.names)
            made = replace(made, given_up=aim.lost, proof=f"{names} cannot be where {aim.text} has it", proof_kind="limits")
            reasons.append(f"{made.proof}; the end effector's pose there is aimed at")
        if len(goals):
            route, apart = self._way(here, goals, aim.poses, aim.q)
            if route is not None:
                self._add("to the goal", route.q, route.lower_bound, route.straight)
                return replace(made, ending=ending, goal_pose=aim.poses[owner[route.goal]], reason="; ".join(reasons))
            self._look("looking for a route to the goal")
            counted = f"{self.tries} search{'es' * (self.tries != 1)}"
            searches = "the searches" if self.space.spent or self.space.closed_in else counted
            found = f"{len(goals)} configurations of the goal were found and {searches} led to none of them"
            reasons.append(found + self.space.in_the_way(here, goals[0]))
            if apart is not None and aim.lost is None:
                made = replace(made, proof=apart[0], reason=apart[0], proved_within=apart[1], proof_kind="disconnected")
                return replace(made, ending=Ending.PROVED_DISCONNECTED)
            why, closed_in = "; ".join(reasons), self.space.closed_in if made.within is None else ""
            unknown = f"configurations were found, but no motion to them; {shape}" if (shape := unknown_shape(seen)) else ""
            ended = replace(made, given_up=None, reason=why, closed_in=closed_in, unknown=unknown)
            return replace(ended, ending=Ending.NO_ROUTE_FOUND)
        bounds = [unreachable(self.solver, self.space.free, here, pose) for pose in aim.poses]
        proofs = [bound or box for bound, box in zip(bounds, none, strict=True)]
        proof = None if None in proofs else f"{proofs[0]}{'' if made.within is None else ANY_ORIENTATION}"
        pair = "" if proof else what_bars(self.solver, self.space, aim.poses, here, made.seed)
        found = "no clear configuration" if pair else "no configuration"
        bars = f"; what is most often in the way where it is met: {pair}" if pair else ""
        reasons.append(proof or f"{found} of the goal was found in {made.starts} starts, which proves nothing{bars}")
        if proof is not None:
            kind: ProofKind = "reach bound" if None not in bounds else "boxes"
            within = made.tolerance is not None and all(
                nothing_within(made.degraded, made.task, pose, self.space, made.tolerance) for pose in aim.poses
            )
            made = replace(made, proof=proof, proof_kind=kind, proved_within=within)
        elif pair and (shape := unknown_shape(seen)):
            made = replace(made, unknown=f"the goal is met where {pair} may be too close; {shape}")
        elif made.within is not None:
            made = replace(made, unknown=f"{reasons[-1]}; a proof would have to cover the whole cone, and there is none")
        offers = [
            (choice, pose)
            for pose in aim.poses
            for choice in rows_to_give_up(self.solver, self.space, self.metric, pose, here, self.rng)
        ]
        offers.sort(key=lambda offer: len(offer[0].rows.names))  # stable: of one pose they are in order
        choices = [choice for choice, _ in offers]
        self._look("looking for rows to give up")
        for choice, pose in offers:
            route = self._route(here, choice.q)
            if route is not None:
                self._add("to the goal", route.q, route.lower_bound, route.straight)
                if not choice.rows.names:  # every row is met: what the search missed was found beside it
                    return replace(made, ending=ending, goal_pose=pose, unknown="", reason="; ".join(reasons[:-1]))
                rows = choice.rows if aim.lost is None else aim.lost + choice.rows
                sets, ending, why = tuple(c.rows for c in choices), Ending.HOME_WITH_ROWS_GIVEN_UP, "; ".join(reasons)
                return replace(made, goal_pose=pose, ending=ending, given_up=rows, choices=sets, reason=why)
        nothing = Ending.PROVED_UNREACHABLE if proof else Ending.NOTHING_FOUND
        if choices:
            reasons.append("rows could be given up, but no motion was found to a configuration without them")
        everything = tuple(c.rows for c in choices if c.rows.names)
        return replace(made, ending=nothing, given_up=None, choices=everything, reason="; ".join(reasons))
