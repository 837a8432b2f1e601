"""Find the remaining capabilities of an arm with a known locked joint, and a route to the goal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from time import monotonic
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from holdfast.arguments import check_arguments
from holdfast.arm.configurations import as_configurations
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.clearance.choice import CellLike, chosen_clearance
from holdfast.clearance.clearance import Clearance
from holdfast.clearance.exact.certainty import describe_unknown_shape
from holdfast.clearance.exact.sharper import with_exact_distances
from holdfast.errors import InputError
from holdfast.failures import Locked, degraded_at
from holdfast.keep.labels import KeepLike, anchor_constraints
from holdfast.notice import reports_progress
from holdfast.recovery.completion import complete_recovery
from holdfast.recovery.continuation import (
    RestOfPath,
    add_motion,
    continue_unfinished_path,
    follow_rest_of_path,
    refine_waypoints,
    relax_fewest_rows,
)
from holdfast.recovery.goals import find_goal_configurations, find_rows_to_relax, name_blocking_pair
from holdfast.recovery.layers import shorten_along_poses
from holdfast.recovery.proofs.of_path import prove_path_infeasible
from holdfast.recovery.proofs.reach import (
    ANY_ORIENTATION,
    Tolerance,
    enumerate_collision_free,
    prove_unreachable,
    proves_no_solution,
)
from holdfast.recovery.proofs.separation import prove_separated
from holdfast.recovery.question import (
    LOCK_TOLERANCE,
    RecoveryGoal,
    check_numbers,
    choose_task,
    describe_doubtful_contact,
    describe_goal_violation,
    find_start_problem,
    parse_goal,
)
from holdfast.recovery.recovery import Leg, ProofKind, Recovery, RecoveryOutcome
from holdfast.recovery.remainder import remaining_workspace
from holdfast.recovery.routes import Route, find_route
from holdfast.recovery.rows import RowSolver, make_row_solver
from holdfast.recovery.second_try import retry_with_exact_distances
from holdfast.recovery.space import FreeSpace, JointMetric, MetricName
from holdfast.recovery.timing.limits import AccelerationsLike, parse_acceleration_limits
from holdfast.regions.region import Region
from holdfast.typing import FloatArray

if TYPE_CHECKING:
    from holdfast.paths.path import Path


@check_arguments
@reports_progress("planning the route")
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
    """Find a route to the goal for an arm with known locked or degraded joints, and report what it can still do.

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
    q_start = q[0]
    degraded = degraded_at(arm, locked, q_start)
    if degraded is None:
        raise InputError(f"no joint is locked; name at least one, for example locked=['{arm.joint_names[0]}']")
    free, limited = degraded.moves, degraded.limited
    if not free.any():
        raise InputError(f"all {arm.n} joints of '{arm.name}' are locked, so nothing can move; leave one free")
    max_accelerations = None if accelerations is None else parse_acceleration_limits(arm, accelerations, free)
    clearance_model = chosen_clearance(arm, clearance, cell)
    if margin and clearance_model is None:
        raise InputError("margin has nothing to keep: no clearance is looked at; give one")
    length = JointMetric.for_arm(limited, metric, None if weights is None else np.asarray(weights, dtype=np.float64), free)
    task_rows = choose_task(arm, task, path, within)
    solver = make_row_solver(arm, task_rows, within).with_limits(limited)
    recovery = Recovery(
        degraded=degraded,
        at=q_start,
        goal="",
        goal_pose=None,
        task=task_rows,
        within=within,
        q=np.zeros((0, arm.n)),
        starts=starts,
        metric=metric,
        unit=length.unit,
        clearance=clearance_model,
        margin=margin,
        keep=anchor_constraints(keep, arm.forward_kinematics(q_start)),
        tolerance=None if tolerance is None else (float(tolerance[0]), float(tolerance[1])),
        seed=seed,
    )
    standing = np.where(free, q_start, degraded.lo)
    target = parse_goal(
        degraded,
        goal,
        within,
        task is not None,
        standing,
        with_exact_distances(clearance_model, margin) or clearance_model,
        margin,
        path,
    )
    recovery = replace(
        recovery,
        goal=target.description if target is not None else "the end of the tool path",
        goal_pose=None if target is None else target.poses[0],
    )
    if samples:
        recovery = replace(recovery, left=remaining_workspace(solver, degraded, clearance_model, margin, region, samples, seed))

    def run_attempt(attempt_clearance: Clearance | None) -> Recovery:
        request = replace(recovery, clearance=attempt_clearance)
        trouble = find_start_problem(degraded, q_start, attempt_clearance, margin, recovery.keep)
        if trouble is not None:
            start_proof = {"proof_kind": "start"} if trouble.certain else {"unknown": trouble.reason}
            return replace(request, ending=trouble.outcome, reason=trouble.reason, **start_proof)  # type: ignore[arg-type]
        around = np.stack([standing, *([] if target is None or target.q is None else [target.q])])
        space = FreeSpace(limited, free, attempt_clearance, margin, around, constraints=recovery.keep)
        if time_limit is not None:
            space.stop_after(time_limit - (monotonic() - began))
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))
        return _RecoverySearch(
            request,
            solver,
            space,
            length,
            tries,
            rng,
            timing_limits=None if max_accelerations is None else (max_accelerations, period),
        ).run(standing, target, path)

    began = monotonic()
    return retry_with_exact_distances(run_attempt(clearance_model), run_attempt)


# ---- the search ----------------------------------------------------------------------------------------------------------


class _RecoverySearch:
    """State of one recovery, step by step."""

    def __init__(
        self,
        recovery: Recovery,
        solver: RowSolver,
        space: FreeSpace,
        metric: JointMetric,
        search_count: int,
        rng: np.random.Generator,
        timing_limits: tuple[FloatArray, float] | None,
    ) -> None:
        self._timing_limits = timing_limits
        self._first_searches = max(
            1, search_count // 4
        )  # of 385 searches that found a route in one of six, all did in the first
        self.recovery, self.solver, self.space, self.metric, self.search_count, self.rng = (
            recovery,
            solver,
            space,
            metric,
            search_count,
            rng,
        )
        self._motions: list[FloatArray] = []
        self._legs: list[Leg] = []
        self._stopped_at = ""

    def run(self, q_start: FloatArray, target: RecoveryGoal | None, path: Path | None) -> Recovery:
        q_current = q_start
        rest: RestOfPath | None = None
        if path is not None:
            rest = self._finish_path(q_current, path)
            q_current = self._motions[-1][-1] if self._motions else q_start
            self.recovery = replace(self.recovery, rest=rest)
        recovery = self.recovery if target is None else self._move_to_goal(q_current, target)
        if (
            rest is not None
            and recovery.ending in (RecoveryOutcome.GOAL_REACHED, RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS)
            and not rest.finished
        ):
            path_relaxed = rest.given_up if len(rest.q) else None
            if path_relaxed is None:
                recovery = replace(recovery, ending=RecoveryOutcome.PATH_UNFINISHED)
            else:
                all_relaxed = path_relaxed if recovery.relaxed is None else path_relaxed + recovery.relaxed
                recovery = replace(recovery, ending=RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS, relaxed=all_relaxed)
        q = np.concatenate(self._motions) if self._motions else self.recovery.q
        recovery = replace(recovery, q=q, legs=tuple(self._legs), stopped=self._stopped_at)
        return (
            complete_recovery(recovery, self.space, self.solver.rows, target, path, self._timing_limits) if len(q) else recovery
        )

    def _note_time_over(self, step_name: str) -> None:
        """Record the step during which the time limit was reached."""
        if self.space.is_time_over and not self._stopped_at:
            self._stopped_at = step_name

    def _add_leg(self, name: str, q: FloatArray, lower_bound: float, straight: bool) -> None:
        length = float(self.metric.cumulative_length(q)[-1])
        first = max(sum(len(motion) for motion in self._motions) - 1, 0)
        self._legs.append(
            Leg(name=name, first=first, last=first + len(q) - 1, length=length, lower_bound=lower_bound, straight=straight)
        )
        self._motions.append(q if not self._motions else q[1:])

    def _finish_path(self, q_current: FloatArray, path: Path) -> RestOfPath:
        """Follow the path if possible; return the first motion that can be reached, the shortest first."""
        rest, motions = follow_rest_of_path(
            self.solver, self.space, self.metric, path, q_current, self.recovery.starts, self.rng
        )
        self._note_time_over("following the tool path")
        if not rest.finished:
            rest, motions = self._extend_path(rest, path, q_current)
        if not rest.finished:
            self.recovery = prove_path_infeasible(self.recovery, rest, path, solver=self.solver, space=self.space)
            shape_doubt, first_lost = describe_unknown_shape(self.space.clearance), rest.first_lost
            first_poses = path.pose(rest.share[:1] if first_lost is None else np.array([first_lost]))
            if shape_doubt and (
                first_lost is None or name_blocking_pair(self.solver, self.space, first_poses, q_current, self.recovery.seed)
            ):
                self.recovery = replace(self.recovery, unknown=f"{rest.why}; {shape_doubt}")
            rest, motions = relax_fewest_rows(rest, self.solver, self.space, path, q_current, self.rng)
            self._note_time_over("looking for rows of the tool path to give up")
        if not motions:
            return rest
        joined_rest = self._join_path(q_current, path, rest, motions)
        if not joined_rest.cut_off or rest.given_up is not None:
            return joined_rest
        rest, motions = self._extend_path(joined_rest, path, q_current)
        return self._join_path(q_current, path, rest, motions) if motions else rest

    def _extend_path(self, rest: RestOfPath, path: Path, q_current: FloatArray) -> tuple[RestOfPath, list[FloatArray]]:
        """Extend the motion along the path as far as possible; also return the motion if it gets to the end."""
        return continue_unfinished_path(
            rest, self.solver, self.space, self.metric, path, q_current, self.recovery.starts, self.rng
        )

    def _join_path(self, q_current: FloatArray, path: Path, rest: RestOfPath, motions: list[FloatArray]) -> RestOfPath:
        """Join the first of the motions along the path that can be reached and is near the path everywhere."""
        route, proof = self._find_route_or_proof(
            q_current, np.stack([candidate[0] for candidate in motions]), path.pose(rest.share[:1])
        )
        self._note_time_over("looking for a route to the tool path")
        if route is None:
            if proof is not None and not self.recovery.proof_kind:
                reason = f"at the beginning of the tool path: {proof[0]}"
                self.recovery = replace(self.recovery, proof=reason, proof_kind="disconnected", proved_within=proof[1])
            return replace(rest, q=np.zeros((0, self.recovery.arm.n)), given_up=None, cut_off=True)
        motion = motions[route.goal]
        if rest.graph:
            motion = shorten_along_poses(self.solver, self.space, self.metric, path.pose(rest.share), motion)
        if rest.given_up is None:
            refinement = refine_waypoints(rest, self.solver, self.space, path, motion)
            if refinement is None and len(motions) > 1 and not self.space.is_time_over:
                return self._join_path(q_current, path, rest, motions[: route.goal] + motions[route.goal + 1 :])
            rest, motion = refinement or (add_motion(rest, self.solver, path, motion), motion)
        motion = motion + (route.q[-1] - motion[0])  # whole turns
        if route.length > LOCK_TOLERANCE:
            self._add_leg("to the path", route.q, route.lower_bound, route.straight)
        else:
            motion[0] = q_current
        self._add_leg("along the path", motion, float(self.metric.measure_length(motion[-1] - motion[0])), False)
        return replace(rest, q=motion)

    def _search_route(self, q_current: FloatArray, goals: FloatArray, repeat_count: int = 0) -> Route | None:
        search_count, max_failures = (repeat_count, None) if repeat_count else (self.search_count, self._first_searches)
        return find_route(self.space, self.metric, q_current, goals, search_count, self.rng, max_failures=max_failures)

    def _find_route_or_proof(
        self, q_current: FloatArray, goals: FloatArray, poses: FloatArray, q_goal: FloatArray | None = None
    ) -> tuple[Route | None, tuple[str, bool] | None]:
        """Find a route, or a proof that there is none; the proof is tried after the first failed searches, before
        the others.
        """
        route = self._search_route(q_current, goals)
        if route is not None:
            return route, None
        proof = prove_separated(
            self.recovery, self.solver.rows, self.space, start=q_current, known_goals=goals, poses=poses, q_goal=q_goal
        )
        if proof is None and self.space.manifold is None and self.search_count > self._first_searches:
            route = self._search_route(q_current, goals, self.search_count - self._first_searches)
        return route, proof

    def _move_to_goal(self, q_current: FloatArray, target: RecoveryGoal) -> Recovery:
        """Find a motion to the goal, or to a goal with relaxed rows."""
        recovery = self.recovery
        violations = [
            describe_goal_violation(recovery.keep, self.solver.rows if target.q is None else None, pose)
            for pose in target.poses
        ]
        if all(violations):
            reason = violations[0]
            return replace(
                recovery, ending=RecoveryOutcome.PROVED_UNREACHABLE, proof=reason, proof_kind="rows kept", reason=reason
            )
        clearance = self.space.clearance
        if target.q is not None and clearance is not None and float(clearance.margin_left(target.q)) < recovery.margin:
            reason = f"at the goal {describe_doubtful_contact(clearance, target.q, recovery.margin)}"
            return replace(recovery, ending=RecoveryOutcome.NOTHING_FOUND, reason=reason, unknown=reason)
        if target.q is not None:
            goals, pose_indices = target.q[None], np.zeros(1, dtype=np.int64)
        else:
            pose_configurations = [
                find_goal_configurations(self.solver, self.space, self.metric, pose, q_current, recovery.starts, self.rng)
                for pose in target.poses
            ]
            goals, pose_indices = (
                np.concatenate(pose_configurations),
                np.repeat(np.arange(len(pose_configurations)), [len(group) for group in pose_configurations]),
            )
        box_proofs: list[str | None] = []
        if not len(goals):
            goals, pose_indices, box_proofs = enumerate_collision_free(recovery, self.solver, self.space, target.poses)
        self._note_time_over("looking for configurations of the goal")
        recovery = replace(recovery, found=len(goals))
        ending = (
            RecoveryOutcome.GOAL_REACHED if target.mismatched_locks is None else RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS
        )
        reasons = []
        if target.mismatched_locks is not None:
            names = " and ".join(target.mismatched_locks.names)
            recovery = replace(
                recovery,
                relaxed=target.mismatched_locks,
                proof=f"{names} cannot be where {target.description} has it",
                proof_kind="limits",
            )
            reasons.append(f"{recovery.proof}; the end effector's pose there is aimed at")
        if len(goals):
            route, separation = self._find_route_or_proof(q_current, goals, target.poses, target.q)
            if route is not None:
                self._add_leg("to the goal", route.q, route.lower_bound, route.straight)
                return replace(
                    recovery, ending=ending, goal_pose=target.poses[pose_indices[route.goal]], reason="; ".join(reasons)
                )
            self._note_time_over("looking for a route to the goal")
            search_text = f"{self.search_count} search{'es' * (self.search_count != 1)}"
            searches = "the searches" if self.space.is_time_over or self.space.closed_in else search_text
            finding_text = f"{len(goals)} configurations of the goal were found and {searches} led to none of them"
            reasons.append(finding_text + self.space.describe_obstruction(q_current, goals[0]))
            if separation is not None and target.mismatched_locks is None:
                recovery = replace(
                    recovery, proof=separation[0], reason=separation[0], proved_within=separation[1], proof_kind="disconnected"
                )
                return replace(recovery, ending=RecoveryOutcome.PROVED_DISCONNECTED)
            reason, closed_in = "; ".join(reasons), self.space.closed_in if recovery.within is None else ""
            unknown = (
                f"configurations were found, but no motion to them; {shape_doubt}"
                if (shape_doubt := describe_unknown_shape(clearance))
                else ""
            )
            failed = replace(recovery, relaxed=None, reason=reason, closed_in=closed_in, unknown=unknown)
            return replace(failed, ending=RecoveryOutcome.NO_ROUTE_FOUND)
        bounds = [prove_unreachable(self.solver, self.space.free, q_current, pose) for pose in target.poses]
        proofs = [reach_proof or box_proof for reach_proof, box_proof in zip(bounds, box_proofs, strict=True)]
        proof = None if None in proofs else f"{proofs[0]}{'' if recovery.within is None else ANY_ORIENTATION}"
        pair = "" if proof else name_blocking_pair(self.solver, self.space, target.poses, q_current, recovery.seed)
        finding_text = "no clear configuration" if pair else "no configuration"
        blocking_text = f"; what is most often in the way where it is met: {pair}" if pair else ""
        reasons.append(
            proof or f"{finding_text} of the goal was found in {recovery.starts} starts, which proves nothing{blocking_text}"
        )
        if proof is not None:
            kind: ProofKind = "reach bound" if None not in bounds else "boxes"
            within = recovery.tolerance is not None and all(
                proves_no_solution(recovery.degraded, recovery.task, pose, self.space, recovery.tolerance)
                for pose in target.poses
            )
            recovery = replace(recovery, proof=proof, proof_kind=kind, proved_within=within)
        elif pair and (shape_doubt := describe_unknown_shape(clearance)):
            recovery = replace(recovery, unknown=f"the goal is met where {pair} may be too close; {shape_doubt}")
        elif recovery.within is not None:
            recovery = replace(
                recovery, unknown=f"{reasons[-1]}; a proof would have to cover the whole cone, and there is none"
            )
        offers = [
            (choice, pose)
            for pose in target.poses
            for choice in find_rows_to_relax(self.solver, self.space, self.metric, pose, q_current, self.rng)
        ]
        offers.sort(key=lambda offer: len(offer[0].relaxed_rows.names))  # stable: of one pose they are in order
        choices = [choice for choice, _ in offers]
        self._note_time_over("looking for rows to give up")
        for choice, pose in offers:
            route = self._search_route(q_current, choice.q)
            if route is not None:
                self._add_leg("to the goal", route.q, route.lower_bound, route.straight)
                if not choice.relaxed_rows.names:  # every row is met: what the search missed was found beside it
                    return replace(recovery, ending=ending, goal_pose=pose, unknown="", reason="; ".join(reasons[:-1]))
                relaxed = (
                    choice.relaxed_rows if target.mismatched_locks is None else target.mismatched_locks + choice.relaxed_rows
                )
                relaxed_sets, ending, reason = (
                    tuple(option.relaxed_rows for option in choices),
                    RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS,
                    "; ".join(reasons),
                )
                return replace(recovery, goal_pose=pose, ending=ending, relaxed=relaxed, choices=relaxed_sets, reason=reason)
        failed_outcome = RecoveryOutcome.PROVED_UNREACHABLE if proof else RecoveryOutcome.NOTHING_FOUND
        if choices:
            reasons.append("rows could be given up, but no motion was found to a configuration without them")
        nonempty_sets = tuple(option.relaxed_rows for option in choices if option.relaxed_rows.names)
        return replace(recovery, ending=failed_outcome, relaxed=None, choices=nonempty_sets, reason="; ".join(reasons))
