"""Find a route to the goal, and the remaining capabilities, of an arm with known locked joints."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from time import monotonic
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.validation import check_arguments
from holdfast.kinematics.regions.region import Region
from holdfast.kinematics.tool_constraints.labels import KeepLike, anchor_constraints
from holdfast.model.arm.configurations import as_configurations
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance
from holdfast.model.collision.exact.exact_clearance import with_exact_distances
from holdfast.model.failure_modes import Locked, degraded_at
from holdfast.response.recovery.attempt import RecoveryAttempt
from holdfast.response.recovery.goals import PoseSearch
from holdfast.response.recovery.problem import check_recovery_options, choose_task, find_start_problem, parse_goal
from holdfast.response.recovery.proofs.path_proof import TriedProofs
from holdfast.response.recovery.proofs.reach import Tolerance
from holdfast.response.recovery.recovery import Recovery, RecoveryOutcome
from holdfast.response.recovery.space import FreeSpace, JointMetric, MetricName
from holdfast.response.recovery.task_rows import make_row_solver
from holdfast.response.recovery.timing.limits import AccelerationsLike, parse_acceleration_limits
from holdfast.response.recovery.workspace_after_failure import estimate_remaining_workspace

if TYPE_CHECKING:
    from holdfast.kinematics.paths.path import Path

_RETRIED_OUTCOMES = (
    RecoveryOutcome.GOAL_REACHED_WITH_RELAXED_ROWS,
    RecoveryOutcome.PATH_UNFINISHED,
    RecoveryOutcome.NO_ROUTE_FOUND,
    RecoveryOutcome.NOTHING_FOUND,
    RecoveryOutcome.START_TOO_CLOSE,
)


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
    relax: bool = True,
    time_limit: float | None = None,
    tolerance: Tolerance | None = None,
    accelerations: AccelerationsLike | None = None,
    period: float = 0.01,
    seed: int = 0,
) -> Recovery:
    """Find a route to the goal for an arm with known locked or degraded joints, and report what it can still do.

    The goal is first searched as a whole: collision-free configurations that meet every row, within the limits and with the
    locks exactly at their values. The shortest motion found to any of them is returned. If none is found, sets of rows are
    relaxed, as few as possible. The motion then ends where the other rows are met, which ``ending`` states.

    Args:
        arm: Healthy arm.
        locked: ``{joint: value}``, joints by name or index from 0, values in rad or m; ``{joint: None}``, or the joints alone,
            for their values in ``at``. Or a :class:`holdfast.Degraded`, which also has reduced ranges and speeds.
        at: (n,) start configuration, rad and m.
        goal: (4, 4) pose of the end effector in the world, m, or (G, 4, 4), any of them; (n,) a configuration; the name of one
            of ``arm.states`` (a built-in arm's home, the states of an SRDF file, the keyframes of an MJCF file). ``"home"`` for
            an arm without this state: all joints at 0, or at the limit nearest to 0. None, with a path: its end. A
            configuration means all its joints, or the end effector's pose there if a task is given. If the lock of a joint
            differs from the configuration, that joint is relaxed and the pose becomes the goal.
        within: Angle in rad by which the tool's z axis may deviate from that of the goal's pose, with any rotation about the
            axis, instead of the orientation rows. A configuration then means its pose. Proofs hold for all orientations.
        task: Task whose rows the end effector's pose must meet. Default: the pose, or the position for a planar arm or for a
            path without orientations.
        path: Rest of a tool path, which is finished before the motion to the goal.
        clearance: Self-collision model. None: capsules of an assumed radius, except for a planar arm; True: for a planar arm
            as well; False: no check.
        cell: Objects around the arm, or their file; every motion is proved collision-free, independently of ``clearance``.
        margin: Smallest distance of the links, m; from an object, in addition to the margin that the cell states for it.
        keep: Tool constraints along the whole motion: :func:`holdfast.kinematics.tool_constraints.upright`,
            :func:`holdfast.kinematics.tool_constraints.rail`, :func:`holdfast.kinematics.tool_constraints.plane`, a label of
            one (``"upright:10deg"``, see :func:`holdfast.kinematics.tool_constraints.by_label`), or several.
        metric: Metric of the shortest route: ``travel`` (Euclidean length of the joints' motion, 1 m as 1 rad) or ``time`` (at
            the velocity limits).
        weights: (n,) weights of the joints in ``travel``. Default: 1.
        region: Targets for the estimate of the remaining workspace. Default: poses of random configurations of the healthy arm.
        samples: Number of these targets; 0: no estimate.
        starts: Random starts of the search for configurations.
        tries: Searches for a route where straight lines are blocked. After a quarter of them failed, a proof is tried first.
        relax: Search a motion with relaxed rows if the whole goal or tool path cannot be met. False: the search ends with the
            proof, or without a motion.
        time_limit: Time limit of the searches, s, without the estimate of the remaining workspace. With a limit, the same seed
            need not give the same result.
        tolerance: Allowed errors of each row of the goal or the tool path, m and rad. Infeasibility is then proved with these
            errors as well if possible, which ``proved_within`` states; motions do not use them.
        accelerations: Limits, rad/s^2 and m/s^2, for the timed motion ``timed`` of the result: a number, n numbers, or one by
            joint. Corners are rounded where this is proved to respect limits, rows and clearance, along a tool path by at most
            half a millimetre and a quarter of a degree; at other corners the arm stops.
        period: Sampling period of the timed motion, s.
        seed: Seed of the searches; the same seed gives the same result.

    Returns:
        A :class:`holdfast.Recovery`. ``ok`` is True only if the whole request is met, verified by independent code. Its
        ``verdict`` is solved, proved infeasible, argued infeasible, or undecided.

    Raises:
        InputError: A joint, angle, goal or number is invalid.
        TaskError: The task is invalid.
    """
    q, single = as_configurations(arm, at)
    if not single:
        raise InputError(f"at has shape {np.shape(at)}; give one configuration of {arm.n} numbers")
    counts = {"samples": (samples, 0), "starts": (starts, 1), "tries": (tries, 0), "seed": (seed, 0)}
    check_recovery_options(counts, time_limit=time_limit, tolerance=tolerance, period=period, margin=margin)
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
        raise InputError("margin has no effect, because collisions are not checked; give a clearance")
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
        clearance_model,
        margin,
        path,
    )
    recovery = replace(
        recovery,
        goal=target.description if target is not None else "the end of the tool path",
        goal_pose=None if target is None else target.poses[0],
    )
    if samples:
        left = estimate_remaining_workspace(solver, degraded, clearance_model, margin, region, samples, seed)
        recovery = replace(recovery, left=left)

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
        timing_limits = None if max_accelerations is None else (max_accelerations, period)
        attempt = RecoveryAttempt(
            recovery=request,
            search=PoseSearch(solver, space, length),
            search_count=tries,
            relaxes_rows=relax,
            rng=rng,
            timing_limits=timing_limits,
            tried_proofs=tried_proofs,
        )
        return attempt.run(standing, target, path)

    began, tried_proofs = monotonic(), TriedProofs()
    return _retry_with_exact_distances(run_attempt(clearance_model), run_attempt, relax)


def _retry_with_exact_distances(recovery: Recovery, search_again: Callable[[Clearance], Recovery], relax: bool) -> Recovery:
    """Return the recovery, or a better one from a second search with exact distances, as in narrow gaps.

    Exact distances change no proof about the start, the separation of start and goal, or the poses. So there is no second
    search after a proof, except after one about poses if no motion with relaxed rows was found.

    Args:
        recovery: Result of the search with the conservative bound of the clearance.
        search_again: Function that repeats the search with another clearance.
        relax: True if motions with relaxed rows are searched.
    """
    is_proved = recovery.proof_kind in ("reach bound", "boxes", "a pose of the path") and (
        recovery.relaxed is not None or not relax
    )
    is_settled = is_proved or recovery.proof_kind in ("start", "disconnected")
    exact_clearance = (
        with_exact_distances(recovery.clearance, recovery.margin)
        if recovery.ending in _RETRIED_OUTCOMES and not is_settled
        else None
    )
    if exact_clearance is None:
        return recovery
    exact_recovery = search_again(exact_clearance)
    if _rank_recovery(exact_recovery) < _rank_recovery(recovery):
        return exact_recovery
    return replace(
        recovery, reason=f"{recovery.reason}; exact distances ({exact_clearance.exact_by}) find no more".lstrip("; ")
    )


def _rank_recovery(recovery: Recovery) -> tuple[float, int, float]:
    """Return the unmet part of the request as a sort key: the outcome, the number of relaxed rows, and the missing path."""
    relaxed, rest = recovery.relaxed, recovery.rest
    outcome_rank = (
        RecoveryOutcome.NO_ROUTE_FOUND - 0.5 if recovery.ending == RecoveryOutcome.PROVED_DISCONNECTED else recovery.ending
    )
    return outcome_rank, 0 if relaxed is None else len(relaxed.names), 0.0 if rest is None else -rest.furthest
