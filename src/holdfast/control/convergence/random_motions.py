"""Random point-to-point motions: start configurations and target poses of the end effector."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, replace

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task
from holdfast.model.failure_modes import FailureSpec, single_joints

_BLOCK_MOTIONS = 256  # motions sampled at a time; the first motions of a seed do not depend on the requested number
_MAX_BLOCKS = 400  # blocks without enough motions before giving up
REACH_TOLERANCE = 1e-6  # m and rad, of the inverse kinematics that decide whether a target is still reached


@dataclass(frozen=True, eq=False)
class PointToPoint:
    """Set of N motions of one arm, each from a configuration to a tool pose.

    Attributes:
        arm: The arm.
        q0: (N, n) configurations at the start, within the limits, rad and m.
        target: (N, 4, 4) tool poses of the targets in the world, m, at ``q_target``.
        q_target: (N, n) configurations at the targets, within the limits, rad and m.
        drawn: Number of motions that were sampled to find these.
        constraints: Phrase that describes the constraints on the motions.
    """

    arm: Arm
    q0: FloatArray
    target: FloatArray
    _: KW_ONLY
    q_target: FloatArray
    drawn: int
    constraints: str

    def __len__(self) -> int:
        return len(self.q0)

    @property
    def distance(self) -> FloatArray:
        """(N,) distances between the tool positions at the start and at the target, m."""
        start_points = self.arm.forward_kinematics(self.q0)[:, :3, 3]
        return np.asarray(np.linalg.norm(self.target[:, :3, 3] - start_points, axis=1))

    def describe(self) -> str:
        """Return a phrase with the number of motions, the arm, and the constraints."""
        return f"{len(self)} motions of {self.arm.title}, {self.constraints}; {self.drawn} were sampled"


@check_arguments
def point_to_point(
    arm: Arm,
    count: int,
    seed: int = 0,
    *,
    distance: tuple[float, float] | None = None,
    failures: FailureSpec | None = None,
    task: str | Task | Sequence[str] = "pose",
    restarts: int = 30,
) -> PointToPoint:
    """Sample random motions from a uniform configuration within the limits to the tool pose of another one.

    A joint without limits is sampled from one turn, or from 1 m to either side.

    Args:
        arm: The arm.
        count: Number of motions.
        seed: Seed of the motions. With one seed, a larger number of motions begins with the motions of a smaller number.
        distance: Least and greatest distance between the tool positions at start and target, m. Default: any distance.
        failures: ``"single"`` (each joint alone), or a list of joints by name or index from 0. The result then contains only
            motions whose target is within reach, within the limits, also with any one of these joints locked at its start.
            The inverse kinematics of :func:`holdfast.solve_ik` decides this, so a target that is hard to reach may be rejected.
        task: Rows of the target that must be within reach after a failure; nothing else depends on the task.
        restarts: Number of random starts of this inverse kinematics.

    Raises:
        InputError: Options are out of range, or too few motions satisfy the constraints.
        TaskError: The arm does not have the task, or a failure does not have exactly one joint.
    """
    if count < 1:
        raise InputError(f"count is {count}; it must be 1 or more")
    if restarts < 1:
        raise InputError(f"restarts is {restarts}; it must be 1 or more")
    nearest, farthest = (0.0, np.inf) if distance is None else distance
    if not 0 <= nearest < farthest:
        raise InputError(f"distance is {nearest:g} to {farthest:g} m; the first must be 0 or more and below the second")
    joints = single_joints(arm, failures)
    chosen = as_task(arm, task)
    constraints = [] if distance is None else [f"{nearest:g} to {farthest:g} m long"]
    if joints:
        joint_text = "any one joint" if len(joints) == arm.n else " or ".join(arm.joint_names[joint] for joint in joints)
        constraints.append(f"target still within reach (task {chosen.name}) with {joint_text} locked at the start")
    constraint_text = ", ".join(constraints) or "sampled within the limits"
    lower, upper = sampling_limits(arm)
    seeds = np.random.SeedSequence(seed)
    blocks: list[PointToPoint] = []
    found_count = sampled_count = 0
    while found_count < count:
        if len(blocks) == _MAX_BLOCKS:
            raise InputError(
                f"only {found_count} of {sampled_count} motions of '{arm.name}' meet the constraints ({constraint_text}), too "
                f"few for {count}; request fewer motions, or relax the constraints"
            )
        block_seed, solving = seeds.spawn(2)
        q0, q1 = np.random.default_rng(block_seed).uniform(lower, upper, (2, _BLOCK_MOTIONS, arm.n))
        block = PointToPoint(
            arm, q0, arm.forward_kinematics(q1), q_target=q1, drawn=_BLOCK_MOTIONS, constraints=constraint_text
        )
        block = _select_motions(block, (block.distance >= nearest) & (block.distance <= farthest))
        for joint in joints:
            block = _select_motions(block, _is_still_reachable(block, chosen, joint, solving, restarts))
        blocks.append(block)
        found_count += len(block)
        sampled_count += _BLOCK_MOTIONS
    q0, target, q_target = (
        np.concatenate([getattr(motions, name) for motions in blocks])[:count] for name in ("q0", "target", "q_target")
    )
    return PointToPoint(arm, q0, target, q_target=q_target, drawn=sampled_count, constraints=constraint_text)


def _is_still_reachable(
    motions: PointToPoint, task: Task, joint: int, seed: np.random.SeedSequence, restarts: int
) -> BoolArray:
    if not len(motions):
        return np.zeros(0, dtype=bool)
    locked = np.full(len(motions), joint)
    ik_solver = solver(motions.arm, task)
    return ik_solver.is_reachable_with_lock(motions.target, locked, motions.q0[:, joint], seed, restarts, REACH_TOLERANCE)


def _select_motions(motions: PointToPoint, selection: BoolArray) -> PointToPoint:
    return replace(motions, q0=motions.q0[selection], target=motions.target[selection], q_target=motions.q_target[selection])
