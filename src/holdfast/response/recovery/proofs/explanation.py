"""Explanation why inverse kinematics found no configuration of a pose: a proof, or a configuration that it missed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.result import Result
from holdfast.core.status import SentenceEnum
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.solvers.inverse_kinematics import Accept, PoseSolutions, solver
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, target_pose
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import chosen_clearance
from holdfast.response.recovery.proofs.blocked_boxes import BlockedBoxes
from holdfast.response.recovery.proofs.reach import EXACT_TOLERANCE, enumerate_configurations, prove_no_configuration

_STARTS_WITHOUT_LIMITS = 512
_LIMIT_ROUNDING = 1e-9  # rad and m: a joint this close to its limit does not exceed it


class PoseVerdict(SentenceEnum):
    """Verdict on a pose for which a solver found no configuration."""

    REACHABLE = 0, "reachable: a configuration was found and checked"
    UNREACHABLE = 1, "unreachable: it is proved up to floating point that no configuration exists"
    UNDECIDED = 2, "undecided: no configuration was found, and there is no proof that none exists"


@dataclass(frozen=True, eq=False, kw_only=True)
class PoseExplanation(Result):
    """Verdict on a pose, with a configuration or a proof, and the conditions without which the pose would be reached.

    Attributes:
        arm: Arm model.
        task: Task whose rows must be met.
        pose: (4, 4) pose of the end effector in the world, m.
        verdict: ``REACHABLE``, ``UNREACHABLE`` or ``UNDECIDED``.
        q: (n,) configuration within the limits that meets the pose, rad and m; if there is none, the nearest one found.
        position_error: Position error of ``q`` in the task rows, m.
        rotation_error: Orientation error of ``q`` in the task rows, rad.
        starts: Number of random starts of inverse kinematics.
        proof: Sentence that contains the proof of ``UNREACHABLE``; empty without one.
        values_beyond_limits: ``{joint: value}``, rad and m, of a configuration that meets the pose and exceeds only these
            limits; empty if none was found without limits either, or if the limits do not prevent the pose.
        colliding_pair: Pair of bodies that is too close in a configuration that meets the pose within the limits; empty if
            no such configuration was found, or if collisions are not checked.
        seconds: Measured duration of the interval search, s; 0 if it was not needed.
    """

    arm: Arm
    task: Task
    pose: FloatArray
    verdict: PoseVerdict
    q: FloatArray
    position_error: float
    rotation_error: float
    starts: int
    proof: str
    values_beyond_limits: Mapping[str, float]
    colliding_pair: str
    seconds: float


@check_arguments
@reports_progress("explaining a pose without a solution")
def explain_ik(
    arm: Arm,
    pose: ArrayLike,
    *,
    task: str | Task | Sequence[str] = "pose",
    clearance: Clearance | bool = False,
    margin: float = 0.0,
    starts: int = 1000,
    time_limit: float = 10.0,
    seed: int = 0,
) -> PoseExplanation:
    """Decide whether a pose without a solution is unreachable, or whether the solver failed.

    Inverse kinematics first searches from many random starts. If it finds nothing, an interval search over the joint limits
    finds a configuration or proves that none exists. Without a configuration, the function also searches without the collision
    check or without the limits, to find the condition that prevents the pose. These searches prove nothing.

    Args:
        arm: Arm model; for a locked joint, an arm with equal limits (:meth:`holdfast.Arm.with_limits`).
        pose: (4, 4) pose of the end effector in the world, m; for a task without orientation also the rows of its position.
        task: Rows of the pose that must be met, within 1e-6 m and 1e-6 rad.
        clearance: Collision model that the configuration must respect; True: the default model of the arm; False: collisions
            are not checked.
        margin: Smallest clearance, m.
        starts: Maximum number of random starts.
        time_limit: Time limit of the interval search, s.
        seed: Seed of the random starts.

    Raises:
        InputError: The pose or a number is invalid, or the clearance belongs to another arm.
    """
    if starts < 1 or not time_limit > 0:
        raise InputError(f"starts is {starts} and time_limit {time_limit:g}; give 1 start or more and a time above 0 s")
    resolved_task = as_task(arm, task)
    wanted = target_pose(resolved_task, pose)
    model = chosen_clearance(arm, clearance)

    def is_clear(q: FloatArray) -> BoolArray:
        return np.ones(len(q), dtype=bool) if model is None else np.asarray(model.margin_left(q) >= margin)

    engine = solver(arm, resolved_task)
    tolerance = engine.scale_tolerance(EXACT_TOLERANCE[0])

    def solve(accept: Accept | None, first: FloatArray | None = None) -> PoseSolutions:
        seeds = np.random.SeedSequence(seed)
        return engine.solve(wanted[None], seeds, starts, tolerance, first=first, accept=accept).first_row

    solution, proof, seconds = solve(is_clear), None, 0.0
    values_beyond_limits, colliding_pair = dict[str, float](), ""
    if not solution.success:
        blocked = None if model is None else BlockedBoxes(model, margin)
        search = enumerate_configurations(arm, resolved_task, wanted, time_limit, blocked)
        seconds = 0.0 if search is None else search.seconds
        candidates = np.zeros((0, arm.n)) if search is None else search.q[is_clear(search.q)]
        if len(candidates):
            solution = solve(is_clear, candidates[:1])
        else:
            proof = prove_no_configuration(search, model, "" if blocked is None else blocked.blocker_names)
    if not solution.success:
        colliding = solve(None)
        if colliding.success and model is not None:
            colliding_pair = model.pair_names[int(model.closest_pair(colliding.q))]
        else:
            values_beyond_limits = _find_values_beyond_limits(arm, resolved_task, wanted, seed)
    return PoseExplanation(
        arm=arm,
        task=resolved_task,
        pose=wanted,
        verdict=PoseVerdict.REACHABLE if solution.success else PoseVerdict.UNREACHABLE if proof else PoseVerdict.UNDECIDED,
        q=solution.q,
        position_error=float(solution.position_error),
        rotation_error=float(solution.rotation_error),
        starts=starts,
        proof=proof or "",
        values_beyond_limits=values_beyond_limits,
        colliding_pair=colliding_pair,
        seconds=seconds,
    )


def _find_values_beyond_limits(arm: Arm, task: Task, pose: FloatArray, seed: int) -> dict[str, float]:
    """Return the joint values beyond the limits in the configuration that exceeds the fewest limits, and these the least.

    The result is empty if no configuration was found without limits.
    """
    engine, (lower, upper) = solver(arm.without_limits, task), sampling_limits(arm)
    initial = np.random.default_rng(seed).uniform(lower, upper, (_STARTS_WITHOUT_LIMITS, arm.n))
    tolerance = engine.scale_tolerance(EXACT_TOLERANCE[0])
    q, is_reached = engine.attempt(initial, np.repeat(pose[None], len(initial), axis=0), tolerance)
    if not is_reached.any():
        return {}
    turns = np.where(arm.prismatic, 0.0, np.round((q[is_reached] - (lower + upper) / 2) / (2 * np.pi)))
    q = q[is_reached] - 2 * np.pi * turns
    excess = np.maximum(np.maximum(arm.lower - q, q - arm.upper), 0.0)
    is_beyond = excess > _LIMIT_ROUNDING
    best = np.lexsort((excess.sum(axis=1), is_beyond.sum(axis=1)))[0]
    return {arm.joint_names[joint]: float(q[best, joint]) for joint in np.flatnonzero(is_beyond[best])}
