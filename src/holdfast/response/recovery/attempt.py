"""One search for a recovery with a given clearance: along the tool path first, then to the goal, in stages."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.collision.exact.certainty import describe_unknown_shape
from holdfast.response.recovery.completion import verify_and_time_recovery
from holdfast.response.recovery.continuation import (
    RestOfPath,
    add_motion_with_deviation,
    follow_rest_of_path,
    follow_to_furthest_point,
    follow_with_relaxed_rows,
    refine_waypoints,
)
from holdfast.response.recovery.goals import PoseSearch, find_goal_configurations, find_relaxed_goals, name_blocking_pair
from holdfast.response.recovery.ladder_graph import shorten_along_poses
from holdfast.response.recovery.problem import LOCK_TOLERANCE, RecoveryGoal, describe_doubtful_contact, describe_goal_violation
from holdfast.response.recovery.proofs.path_proof import TriedProofs, prove_path_infeasible
from holdfast.response.recovery.proofs.reach import (
    ANY_ORIENTATION,
    PoseProof,
    enumerate_collision_free,
    prove_unreachable,
    prove_within_tolerance,
)
from holdfast.response.recovery.proofs.separation import prove_goal_disconnected
from holdfast.response.recovery.recovery import Leg, ProofKind, Recovery, RecoveryOutcome
from holdfast.response.recovery.routes import BRIEF_ROUNDS, MAX_ROUNDS, Route, find_route

if TYPE_CHECKING:
    from holdfast.kinematics.paths.path import Path


@dataclass(frozen=True, kw_only=True)
class UndecidedGoal:
    """Goal for which no stage of the search has decided the outcome so far.

    Attributes:
        recovery: Recovery with the findings of the stages so far.
        q_start: (n,) configuration in which the motion to the goal starts, rad and m.
        target: Goal.
        configurations: (K, n) valid configurations of the goal, rad and m.
        pose_indices: (K,) index of the pose of the goal that each configuration meets.
        reach_proofs: Proof for each pose of the goal that it is too far away or too near, or None; only without configurations.
        box_proofs: Proof for each pose of the goal that no configuration meets it, or None; only without configurations.
        reasons: Sentences about the obstacles to a motion, in the order in which they were found.
        is_proved_unreachable: True if a proof shows that no configuration meets the goal.
    """

    recovery: Recovery
    q_start: FloatArray
    target: RecoveryGoal
    configurations: FloatArray
    pose_indices: IndexArray = field(default_factory=lambda: np.zeros(1, dtype=np.int64))
    reach_proofs: tuple[str | None, ...] = ()
    box_proofs: tuple[PoseProof | None, ...] = ()
    reasons: tuple[str, ...] = ()
    is_proved_unreachable: bool = False

    @property
    def success(self) -> RecoveryOutcome:
        """Outcome of a motion that meets every row of the goal's pose."""
        if self.target.mismatched_locks is None:
            return RecoveryOutcome.GOAL_REACHED
        return RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS


@dataclass(eq=False, kw_only=True)
class RecoveryAttempt:
    """State of one search for a recovery.

    Attributes:
        recovery: Request, and the findings along the tool path.
        search: Search for configurations that meet the rows of the task, and valid motions.
        search_count: Number of searches for a route where straight lines are blocked.
        relaxes_rows: True to search motions with relaxed rows if the whole goal is not met.
        rng: Random number generator.
        timing_limits: Accelerations (n,), rad/s^2 and m/s^2, and the period of the timed motion, s; None: no timed motion.
        tried_proofs: Results of proofs about the tool path.
    """

    recovery: Recovery
    search: PoseSearch
    search_count: int
    relaxes_rows: bool
    rng: np.random.Generator
    timing_limits: tuple[FloatArray, float] | None
    tried_proofs: TriedProofs
    _motions: list[FloatArray] = field(default_factory=list, init=False)
    _legs: list[Leg] = field(default_factory=list, init=False)
    _stopped_at: str = field(default="", init=False)

    @property
    def _search_count_before_proof(self) -> int:
        """Number of searches before a proof is tried."""
        return max(1, self.search_count // 4)  # the first of six searches found all of 385 routes

    def run(self, q_start: FloatArray, target: RecoveryGoal | None, path: Path | None) -> Recovery:
        """Return the recovery from a valid configuration (n,): along the path, if there is one, then to the goal."""
        q_current = q_start
        rest: RestOfPath | None = None
        if path is not None:
            rest = self._plan_rest_of_path(q_current, path)
            q_current = self._motions[-1][-1] if self._motions else q_start
            self.recovery = replace(self.recovery, rest=rest)
        recovery = self.recovery if target is None else self._move_to_goal(q_current, target)
        is_reached = recovery.ending in (RecoveryOutcome.GOAL_REACHED, RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS)
        if rest is not None and is_reached and not rest.finished:
            path_relaxed = rest.given_up if len(rest.q) else None
            if path_relaxed is None:
                recovery = replace(recovery, ending=RecoveryOutcome.PATH_UNFINISHED)
            else:
                all_relaxed = path_relaxed if recovery.relaxed is None else path_relaxed + recovery.relaxed
                recovery = replace(recovery, ending=RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS, relaxed=all_relaxed)
        q = np.concatenate(self._motions) if self._motions else self.recovery.q
        recovery = replace(recovery, q=q, legs=tuple(self._legs), stopped=self._stopped_at)
        if not len(q):
            return recovery
        return verify_and_time_recovery(recovery, self.search.space, self.search.solver.rows, target, path, self.timing_limits)

    def _record_timeout_step(self, step_name: str) -> None:
        """Record the step during which the time limit was reached."""
        if self.search.space.is_time_over and not self._stopped_at:
            self._stopped_at = step_name

    def _add_leg(self, name: str, q: FloatArray, lower_bound: float, straight: bool) -> None:
        length = float(self.search.metric.cumulative_length(q)[-1])
        first = max(sum(len(motion) for motion in self._motions) - 1, 0)
        self._legs.append(
            Leg(name=name, first=first, last=first + len(q) - 1, length=length, lower_bound=lower_bound, straight=straight)
        )
        self._motions.append(q if not self._motions else q[1:])

    def _plan_rest_of_path(self, q_current: FloatArray, path: Path) -> RestOfPath:
        """Follow the path if possible; return the first motion that can be reached, the shortest first."""
        rest, motions = follow_rest_of_path(self.search, path, q_current, self.recovery.starts, self.rng)
        self._record_timeout_step("while following the tool path")
        if not rest.finished:
            rest, motions = self._extend_path(rest, path, q_current)
        if not rest.finished:
            self.recovery = prove_path_infeasible(self.recovery, rest, path, self.search, self.tried_proofs)
            shape_doubt, first_lost = describe_unknown_shape(self.search.space.clearance), rest.first_lost
            first_poses = path.pose(rest.share[:1] if first_lost is None else np.array([first_lost]))
            if shape_doubt and (
                first_lost is None or name_blocking_pair(self.search, first_poses, q_current, self.recovery.seed)
            ):
                self.recovery = replace(self.recovery, unknown=f"{rest.why}; {shape_doubt}")
            if self.relaxes_rows:
                rest, motions = follow_with_relaxed_rows(rest, self.search, path, q_current, self.rng)
            self._record_timeout_step("while searching for rows of the tool path to relax")
        if not motions:
            return rest
        joined_rest = self._connect_start_to_path(q_current, path, rest, motions)
        if not joined_rest.cut_off or rest.given_up is not None:
            return joined_rest
        rest, motions = self._extend_path(joined_rest, path, q_current)
        return self._connect_start_to_path(q_current, path, rest, motions) if motions else rest

    def _extend_path(self, rest: RestOfPath, path: Path, q_current: FloatArray) -> tuple[RestOfPath, list[FloatArray]]:
        """Extend the motion along the path as far as possible; also return the motion if it reaches the end."""
        return follow_to_furthest_point(rest, self.search, path, q_current, self.recovery.starts, self.rng)

    def _connect_start_to_path(
        self, q_current: FloatArray, path: Path, rest: RestOfPath, motions: list[FloatArray]
    ) -> RestOfPath:
        """Join the first of the motions along the path that can be reached and is near the path everywhere."""
        route, proof = self._find_route_or_proof(
            q_current, np.stack([candidate[0] for candidate in motions]), path.pose(rest.share[:1])
        )
        self._record_timeout_step("while searching for a route to the tool path")
        if route is None:
            if proof is not None and not self.recovery.proof_kind:
                reason = f"at the beginning of the tool path: {proof[0]}"
                self.recovery = replace(self.recovery, proof=reason, proof_kind="disconnected", proved_within=proof[1])
            return replace(rest, q=np.zeros((0, self.recovery.arm.n)), given_up=None, cut_off=True)
        motion = motions[route.goal]
        if rest.graph:
            motion = shorten_along_poses(self.search, path.pose(rest.share), motion)
        if rest.given_up is None:
            refinement = refine_waypoints(rest, self.search, path, motion)
            if refinement is None and len(motions) > 1 and not self.search.space.is_time_over:
                return self._connect_start_to_path(q_current, path, rest, motions[: route.goal] + motions[route.goal + 1 :])
            rest, motion = refinement or (add_motion_with_deviation(rest, self.search.solver, path, motion), motion)
        motion = motion + (route.q[-1] - motion[0])  # full revolutions
        if route.length > LOCK_TOLERANCE:
            self._add_leg("to the path", route.q, route.lower_bound, route.straight)
        else:
            motion[0] = q_current
        self._add_leg("along the path", motion, float(self.search.metric.measure_length(motion[-1] - motion[0])), False)
        return replace(rest, q=motion)

    def _search_route(
        self, q_current: FloatArray, goals: FloatArray, repeat_count: int = 0, max_rounds: int = MAX_ROUNDS
    ) -> Route | None:
        search_count, max_failures = (
            (repeat_count, None) if repeat_count else (self.search_count, self._search_count_before_proof)
        )
        space, metric = self.search.space, self.search.metric
        return find_route(
            space, metric, q_current, goals, search_count, self.rng, max_failures=max_failures, max_rounds=max_rounds
        )

    def _find_route_or_proof(
        self, q_current: FloatArray, goals: FloatArray, poses: FloatArray, q_goal: FloatArray | None = None
    ) -> tuple[Route | None, tuple[str, bool] | None]:
        """Find a route, or a proof that there is none; the proof is tried after the first failed searches."""
        further_searches = self.search_count - self._search_count_before_proof
        is_brief = self.search.space.manifold is not None and further_searches > 0
        route = self._search_route(q_current, goals, max_rounds=BRIEF_ROUNDS if is_brief else MAX_ROUNDS)
        if route is not None:
            return route, None
        proof = prove_goal_disconnected(
            self.recovery,
            self.search.space,
            start=q_current,
            known_goals=goals,
            poses=poses,
            q_goal=q_goal,
        )
        if proof is None and further_searches > 0:
            route = self._search_route(q_current, goals, further_searches)
        return route, proof

    def _move_to_goal(self, q_start: FloatArray, target: RecoveryGoal) -> Recovery:
        """Find a motion to the goal, or to the goal with relaxed rows; the search ends with the first stage that decides."""
        q_goals = np.zeros((0, self.recovery.arm.n)) if target.q is None else target.q[None]
        result: Recovery | UndecidedGoal
        result = UndecidedGoal(recovery=self.recovery, q_start=q_start, target=target, configurations=q_goals)
        for stage in (self._find_goal_configurations, self._find_route_to_goals, self._prove_unreachable):
            result = stage(result)
            if isinstance(result, Recovery):
                return result
        return self._plan_with_relaxed_rows(result)

    def _find_goal_configurations(self, goal: UndecidedGoal) -> Recovery | UndecidedGoal:
        """Find configurations of the goal; decide a goal that violates a tool constraint, or that may be in contact."""
        recovery, target, space = goal.recovery, goal.target, self.search.space
        rows = self.search.solver.rows if target.q is None else None
        violations = [describe_goal_violation(recovery.keep, rows, pose) for pose in target.poses]
        if all(violations):
            decided = replace(recovery, proof=violations[0], proof_kind="rows kept", reason=violations[0])
            return replace(decided, ending=RecoveryOutcome.PROVED_UNREACHABLE)
        if target.q is None:
            pose_configurations = [
                find_goal_configurations(self.search, pose, goal.q_start, recovery.starts, self.rng) for pose in target.poses
            ]
            pose_indices = np.repeat(np.arange(len(target.poses)), [len(q) for q in pose_configurations])
            goal = replace(goal, configurations=np.concatenate(pose_configurations), pose_indices=pose_indices)
        elif space.clearance is not None and float(space.clearance.margin_left(target.q)) < recovery.margin:
            reason = f"at the goal {describe_doubtful_contact(space.clearance, target.q, recovery.margin)}"
            return replace(recovery, ending=RecoveryOutcome.NOTHING_FOUND, reason=reason, unknown=reason)
        if not len(goal.configurations):
            reach_proofs = [prove_unreachable(self.search.solver, space.free, goal.q_start, pose) for pose in target.poses]
            goal = replace(goal, reach_proofs=tuple(reach_proofs), box_proofs=(None,) * len(reach_proofs))
        if None in goal.reach_proofs:
            q, pose_indices, proofs = enumerate_collision_free(recovery, self.search, target.poses)
            goal = replace(goal, configurations=q, pose_indices=pose_indices, box_proofs=tuple(proofs))
        self._record_timeout_step("while searching for configurations of the goal")
        recovery = replace(recovery, found=len(goal.configurations))
        if target.mismatched_locks is None:
            return replace(goal, recovery=recovery)
        proof = f"{' and '.join(target.mismatched_locks.names)} cannot have the value of {target.description}"
        recovery = replace(recovery, relaxed=target.mismatched_locks, proof=proof, proof_kind="limits")
        return replace(goal, recovery=recovery, reasons=(f"{proof}; the goal is the end effector's pose there instead",))

    def _find_route_to_goals(self, goal: UndecidedGoal) -> Recovery | UndecidedGoal:
        """Decide a goal with configurations by a route to one of them, a proof that there is none, or failed searches."""
        recovery, target, space, configurations = goal.recovery, goal.target, self.search.space, goal.configurations
        if not len(configurations):
            return goal
        route, separation = self._find_route_or_proof(goal.q_start, configurations, target.poses, target.q)
        if route is not None:
            self._add_leg("to the goal", route.q, route.lower_bound, route.straight)
            pose = target.poses[goal.pose_indices[route.goal]]
            return replace(recovery, ending=goal.success, goal_pose=pose, reason="; ".join(goal.reasons))
        self._record_timeout_step("while searching for a route to the goal")
        if separation is not None and target.mismatched_locks is None:
            decided = replace(recovery, proof=separation[0], reason=separation[0], proved_within=separation[1])
            return replace(decided, proof_kind="disconnected", ending=RecoveryOutcome.PROVED_DISCONNECTED)
        search_text = f"{self.search_count} search{'es' * (self.search_count != 1)}"
        searches = "the searches" if space.is_time_over or space.closed_in else search_text
        finding_text = f"{len(configurations)} configurations of the goal were found and {searches} led to none of them"
        obstruction = space.describe_obstruction(goal.q_start, configurations[0])
        shape_doubt = describe_unknown_shape(space.clearance)
        return replace(
            recovery,
            ending=RecoveryOutcome.NO_ROUTE_FOUND,
            relaxed=None,
            reason="; ".join((*goal.reasons, finding_text + obstruction)),
            closed_in=space.closed_in if recovery.within is None else "",
            unknown=f"configurations were found, but no motion to them; {shape_doubt}" if shape_doubt else "",
        )

    def _prove_unreachable(self, goal: UndecidedGoal) -> UndecidedGoal:
        """Add the proof that no configuration meets the goal, or the unknown property where there is no proof."""
        recovery, target, space = goal.recovery, goal.target, self.search.space
        proofs = [
            box_proof if sentence is None else PoseProof(sentence, bool(prove_within_tolerance(recovery, self.search, pose)))
            for sentence, box_proof, pose in zip(goal.reach_proofs, goal.box_proofs, target.poses, strict=True)
        ]
        if proofs[0] is not None and None not in proofs:
            proof = f"{proofs[0].sentence}{'' if recovery.within is None else ANY_ORIENTATION}"
            kind: ProofKind = "reach bound" if None not in goal.reach_proofs else "boxes"
            within = all(proof is not None and proof.holds_within_tolerance for proof in proofs)
            recovery = replace(recovery, proof=proof, proof_kind=kind, proved_within=within)
            return replace(goal, recovery=recovery, reasons=(*goal.reasons, proof), is_proved_unreachable=True)
        pair = name_blocking_pair(self.search, target.poses, goal.q_start, recovery.seed)
        finding_text = "no collision-free configuration" if pair else "no configuration"
        blocking_text = f"; the most frequent collision where the goal is met: {pair}" if pair else ""
        reason = f"{finding_text} of the goal was found in {recovery.starts} starts, which proves nothing{blocking_text}"
        if pair and (shape_doubt := describe_unknown_shape(space.clearance)):
            recovery = replace(recovery, unknown=f"the goal is met where {pair} may be too close; {shape_doubt}")
        elif recovery.within is not None:
            recovery = replace(recovery, unknown=f"{reason}; no available proof covers the whole cone")
        return replace(goal, recovery=recovery, reasons=(*goal.reasons, reason))

    def _plan_with_relaxed_rows(self, goal: UndecidedGoal) -> Recovery:
        """Find a motion to the goal with the fewest relaxed rows; without one, report that the goal is not reached."""
        recovery, locks = goal.recovery, goal.target.mismatched_locks
        poses = goal.target.poses if self.relaxes_rows else ()
        relaxed_goals = [(find_relaxed_goals(self.search, pose, goal.q_start, self.rng), pose) for pose in poses]
        offers = [(choice, pose) for choices, pose in relaxed_goals for choice in choices]
        offers.sort(key=lambda offer: len(offer[0].relaxed_rows.names))  # stable: of one pose they are in order
        choices = tuple(choice.relaxed_rows for choice, _ in offers)
        self._record_timeout_step("while searching for rows to relax")
        for choice, pose in offers:
            route = self._search_route(goal.q_start, choice.q)
            if route is None:
                continue
            self._add_leg("to the goal", route.q, route.lower_bound, route.straight)
            recovery = replace(recovery, goal_pose=pose)
            if not choice.relaxed_rows.names:  # this search found a configuration that the first search missed
                return replace(recovery, ending=goal.success, unknown="", reason="; ".join(goal.reasons[:-1]))
            relaxed = choice.relaxed_rows if locks is None else locks + choice.relaxed_rows
            recovery = replace(recovery, relaxed=relaxed, choices=choices, reason="; ".join(goal.reasons))
            return replace(recovery, ending=RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS)
        no_motion = "rows could be relaxed, but no motion was found to a configuration without them"
        return replace(
            recovery,
            ending=RecoveryOutcome.PROVED_UNREACHABLE if goal.is_proved_unreachable else RecoveryOutcome.NOTHING_FOUND,
            relaxed=None,
            choices=tuple(rows for rows in choices if rows.names),
            reason="; ".join((*goal.reasons, no_motion) if choices else goal.reasons),
        )
