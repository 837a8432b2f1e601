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
from holdfast.kinematics.solvers.inverse_kinematics import PoseSolutions, solver
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, default_path_task, target_pose
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import chosen_clearance
from holdfast.response.recovery.proofs.blocked_boxes import BlockedBoxes
from holdfast.response.recovery.proofs.reach import EXACT_TOLERANCE, enumerate_configurations, prove_no_configuration

_STARTS_WITHOUT_LIMITS = 512
_ROUNDING = 1e-9  # rad and m: a joint this close to its limit does not exceed it


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
        is_position_reached: True if the position is reached in another orientation; None for a task without orientation.
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
    is_position_reached: bool | None
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
    finds a configuration or proves that none exists. Without a configuration, the function also drops the limits, the collision
    check and the orientation in turn, to find the condition that prevents the pose. These searches prove nothing.

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

    def solve(task: Task, first: FloatArray | None = None, collides: bool = False) -> PoseSolutions:
        engine = solver(arm, task)
        return engine.solve(
            wanted[None],
            np.random.SeedSequence(seed),
            starts,
            engine.scale_tolerance(EXACT_TOLERANCE[0]),
            first=first,
            accept=None if collides else is_clear,
        ).first_row

    solution, proof, seconds = solve(resolved_task), None, 0.0
    values_beyond_limits, colliding_pair, is_position_reached = dict[str, float](), "", None
    if not solution.success:
        blocked = None if model is None else BlockedBoxes(model, margin)
        search = enumerate_configurations(arm, resolved_task, wanted, time_limit, blocked)
        seconds = 0.0 if search is None else search.seconds
        candidates = np.zeros((0, arm.n)) if search is None else search.q[is_clear(search.q)]
        if len(candidates):
            solution = solve(resolved_task, first=candidates[:1])
        else:
            proof = prove_no_configuration(search, model, "" if blocked is None else blocked.blocker_names)
    if not solution.success:
        colliding = solve(resolved_task, collides=True)
        if colliding.success and model is not None:
            colliding_pair = model.pair_names[int(model.closest_pair(colliding.q))]
        else:
            values_beyond_limits = _find_values_beyond_limits(arm, resolved_task, wanted, seed)
        if resolved_task.m > (position_task := as_task(arm, default_path_task(arm, False))).m:
            is_position_reached = bool(solve(position_task).success)
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
        is_position_reached=is_position_reached,
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
    is_beyond = excess > _ROUNDING
    best = np.lexsort((excess.sum(axis=1), is_beyond.sum(axis=1)))[0]
    return {arm.joint_names[joint]: float(q[best, joint]) for joint in np.flatnonzero(is_beyond[best])}
