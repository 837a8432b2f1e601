"""Best configurations of given poses, compared with the present configurations of an arm."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.caching import cached_property
from holdfast.core.errors import HoldfastError, InputError
from holdfast.core.formatting import format_number
from holdfast.core.progress import ProgressCount, reports_progress
from holdfast.core.result import Result
from holdfast.core.status import Status
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kernels.threads import in_pool, shared_pool, thread_count
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.solvers.free_pose import FREE_STARTS, optimise_without_pose
from holdfast.kinematics.solvers.joint_space import wrap_around_limit_center
from holdfast.kinematics.solvers.optimum import Optimum, default_starts, get_cached_ascent
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import check_poses
from holdfast.model.arm.task import Task, as_task
from holdfast.model.collision.clearance_argument import CellLike, chosen_clearance

if TYPE_CHECKING:
    from holdfast.model.collision.clearance import Clearance


_SMALL_FRACTION = 0.1  # of a loss, and of the value before it
_ZERO_TOLERANCE = 1e-9  # index after a failure below which only rounding remains
_BLOCK_POSES = 512  # poses that one thread optimises together; no result depends on it


@dataclass(frozen=True, kw_only=True)
class Cap:
    """Failure that limits the optimised worst case, so that the other failures lose much for almost no gain.

    Values are medians over the poses, of the index before and after optimisation.

    Attributes:
        failure: Name of the joint, or joints, whose failure is the worst one after optimisation.
        before, after: Value after this failure.
        other: Name of the failure with the largest loss.
        other_before, other_after: Value after that failure.
        remaining: Positions in ``index.failures`` of all failures but the first one.
    """

    failure: str
    before: float
    after: float
    other: str
    other_before: float
    other_after: float
    remaining: tuple[int, ...]

    def __str__(self) -> str:
        return (
            f"{self.failure} caps the value: after its failure the index is {format_number(self.before)} before optimisation "
            f"and {format_number(self.after)} after it, while after a failure of {self.other} it is "
            f"{format_number(self.other_before)} before and {format_number(self.other_after)} after"
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Optima(Optimum, Result):
    """Result and inputs of :func:`optimise` for N poses, or for one (without the leading N).

    Attributes:
        objective: Objective of the optimisation.
        task: Rows of the pose that are met.
        free: True if no pose was given, so that the best configuration of all was sought.
        poses: (N, 4, 4) poses in the world, m; without given poses that of the best configuration.
        initial: (N, n) configurations for comparison, rad and m, or None.
        clearance: Collision model of the arm and its cell, or None.
        margin: Smallest clearance, m.
        seed: Seed of the starts.
    """

    objective: Objective
    task: Task
    free: bool
    poses: FloatArray
    initial: FloatArray | None
    clearance: Clearance | None
    margin: float
    seed: int

    @property
    def arm(self) -> Arm:
        """Arm model."""
        return self.objective.arm

    @property
    def rows(self) -> Optima:
        """Result with the leading N, also for one pose."""
        if self.q.ndim == 2:
            return self
        arrays = {field.name: getattr(self, field.name)[None] for field in fields(Optimum)}
        initial = None if self.initial is None else self.initial[None]
        return replace(self, **arrays, poses=self.poses[None], initial=initial)

    @property
    def q_before(self) -> FloatArray:
        """Configurations (N, n) that were given or found first (without poses the best random one); NaN if none was found."""
        return np.where(self.success[..., None], self.start_q, np.nan) if self.initial is None else self.initial

    @property
    def value_before(self) -> FloatArray:
        """Value (N,) of the objective at :attr:`q_before`."""
        return self.start_value if self.initial is None else self.objective(self.initial)

    def clearance_at(self, q: FloatArray) -> FloatArray:
        """Return the clearance of the arm from itself and its cell, (N,) m, at ``q`` (N, n); NaN if no clearance is given."""
        return np.full(q.shape[:-1], np.nan) if self.clearance is None else self.clearance(q)

    def close(self, q: FloatArray) -> BoolArray:
        """Return (N,) True where the clearance at ``q`` (N, n) is below the margin; False if no clearance is given."""
        return np.zeros(q.shape[:-1], dtype=bool) if self.clearance is None else self.clearance.margin_left(q) < self.margin

    @property
    def obstacles(self) -> list[str]:
        """Pair of each pose, ``panda_joint4 & table``, that blocks the best unconstrained configuration, or an empty string.

        For a pose with the status INFEASIBLE it is the pair that blocks most of the configurations found.
        """
        rows = self.rows
        names = [] if self.clearance is None else self.clearance.pair_names
        return [names[pair] if pair >= 0 else "" for pair in rows.blocked_by]

    @property
    def worse(self) -> BoolArray:
        """Flags (N,) of the given configurations that are better than those found and equally collision-free."""
        loss = (self.value_before - self.value) * (1 if self.objective.better == "larger" else -1)
        better = loss > 1e-9 * np.abs(self.value)
        return np.asarray(better & ~self.close(self.q_before))

    @cached_property
    def cap(self) -> Cap | None:
        """Failure that caps the value; None if the gain is worth the loss of the others, or there is only one failure.

        A failure caps the value if it is the worst one in at least half of the best configurations, and either nothing remains
        after it, or the value gains at most a tenth of the largest loss after another failure.
        """
        index, rows = self.objective, self.rows
        if not isinstance(index, Index) or len(index.failures) < 2 or not rows.success.any():
            return None
        before, after = (index.by_joint(q[rows.success]) for q in (rows.q_before, rows.q))
        if not (np.isfinite(before) & np.isfinite(after)).all():
            return None
        sign = 1.0 if index.better == "larger" else -1.0
        lowest = (sign * after).min(axis=1, keepdims=True)
        tied = sign * after <= lowest + 1e-3 * np.abs(lowest)
        worst = np.where(tied, sign * before, np.inf).argmin(axis=1)  # of several failures the one that was worst before
        capping = int(np.bincount(worst).argmax())
        old_medians, new_medians = np.median(before, axis=0), np.median(after, axis=0)
        losses = sign * (old_medians - new_medians)
        losses[capping] = -np.inf
        loser, gain = int(losses.argmax()), float(np.median(lowest[:, 0] - (sign * before).min(axis=1)))
        hopeless = abs(new_medians[capping]) <= _ZERO_TOLERANCE and losses[loser] > 0
        costly = losses[loser] > _SMALL_FRACTION * abs(old_medians[loser]) and gain <= _SMALL_FRACTION * losses[loser]
        if 2 * (worst == capping).sum() < len(worst) or not (hopeless or costly):
            return None
        return Cap(
            failure=index.failure_names[capping],
            before=float(old_medians[capping]),
            after=float(new_medians[capping]),
            other=index.failure_names[loser],
            other_before=float(old_medians[loser]),
            other_after=float(new_medians[loser]),
            remaining=tuple(failure for failure in range(len(index.failures)) if failure != capping),
        )

    def require_any(self) -> Optima:
        """Return the result if any pose has a configuration.

        Raises:
            HoldfastError: No pose has one; the message suggests what to try.
        """
        if self.success.any():
            return self
        first_status = Status(int(self.status.flat[0])) if self.status.size else Status.NOT_FOUND
        advice = first_status.sentence
        if first_status == Status.INFEASIBLE and self.clearance is not None:
            pair, shape = int(self.rows.blocked_by[0]), self.clearance.capsules.describe(self.arm)
            is_self_pair = pair < len(self.clearance.pairs)
            advice = (
                f"the arm {self.clearance.too_close(self.margin)} in each that was found (capsules: {shape}), most often by "
                f"{self.clearance.pair_names[pair]}: choose another pose, give the real shape by --capsules or a smaller "
                "--margin, " + ("or allow the contact by --no-clearance" if is_self_pair else "or move the object")
            )
        raise HoldfastError(f"no configuration of {'the pose' if self.status.size == 1 else 'any pose'}: {advice}")

    def to_csv(self, file: str | Path) -> Path:
        """Write the configurations as rows to the CSV ``file``, with values before and after.

        Raises:
            StoreError: The file cannot be written.
        """
        written: Path = self._present("to_csv", Path(file))
        return written


@check_arguments
@reports_progress("optimising configurations")
def optimise(
    arm: Arm,
    poses: ArrayLike | None,
    objective: Objective,
    *,
    seed: int = 0,
    starts: int | None = None,
    restarts: int = 100,
    tolerance: float = 1e-6,
    task: str | Task | Sequence[str] | None = None,
    clearance: Clearance | bool | None = None,
    cell: CellLike | None = None,
    margin: float = 0.0,
    initial: ArrayLike | None = None,
) -> Optima:
    """Find the best configuration of each pose under an objective, within the joint limits.

    Args:
        arm: Arm model.
        poses: (4, 4) or (N, 4, 4) poses in the world, m; only the rows of the task must be met. None: find the best
            configuration of all within the limits.
        objective: Index, susceptibility or weighted sum of them, which defines the better direction.
        seed: Seed; the same seed gives the same result for any number of threads and of following poses.
        starts: Number of random starts per pose; more starts find better optima, because the problem has many. Default: 128, or
            32 for a redundancy of 2 or more, and up to seven times as many more if fewer than half of them reach the pose.
            Without poses: 10,000, the best of twenty times as many random configurations.
        restarts: Maximum number of random starts of inverse kinematics per pose.
        tolerance: Largest pose error, m and rad.
        task: Rows of the pose to keep. Default: those of the objective, or ``pose`` if it has no task.
        clearance: Collision model that keeps the links apart. True: capsules with an assumed radius. Default: not checked.
        cell: Environment, or its file, to avoid. The links are then kept apart as well, except for a planar arm and with
            ``clearance=False``.
        margin: Smallest clearance, m, in addition to the distances that the cell requires.
        initial: (n,) or (N, n) configurations for comparison, rad and m. One that meets its pose within the limits is also the
            first start of that pose. Default: the first configuration that inverse kinematics finds.

    Returns:
        :class:`Optima`. The value is never worse than that of the first configuration found or given, unless that
            configuration collides.

    Raises:
        InputError: Poses are not 4x4 transforms, an option is out of range, the objective or clearance belongs to another arm,
            or the cell cannot be read or does not fit the arm.
        TaskError: The task differs from the objective's, or the objective cannot be optimised.

    Source: Abdi et al. 2012, eq. (11), (12).
    """
    requested = np.eye(4) if poses is None else poses
    without_pose, targets = poses is None, check_poses(requested)
    initial_q = None if initial is None else arm.check_configurations(initial)
    if initial_q is not None and initial_q.shape[:-1] != np.shape(requested)[:-2]:
        raise InputError(
            f"initial has shape {initial_q.shape}, "
            f"{'no poses are given' if without_pose else f'poses have {np.shape(requested)}'}; "
            f"give one configuration{'' if without_pose else ' of each pose'}"
        )
    if objective.arm.fingerprint != arm.fingerprint:
        raise InputError(f"the objective belongs to '{objective.arm.name}', not to '{arm.name}'; make it with the same arm")
    resolved_clearance = chosen_clearance(arm, clearance, cell, looks=False)
    for name, value in (("starts", starts), ("restarts", restarts)):
        if value is not None and value < 1:
            raise InputError(f"{name} is {value}; it must be 1 or more")
    if not 0 < tolerance <= 1:
        raise InputError(f"tolerance is {tolerance:g}; it must be above 0 and at most 1, m and rad")
    if not np.isfinite(margin):
        raise InputError(f"margin is {margin:g}; it must be a finite number of metres")
    ascent = get_cached_ascent(
        objective, None if task is None else as_task(arm, task), resolved_clearance, margin, without_pose
    )
    scaled_tolerance = ascent.engine.scale_tolerance(tolerance)
    start_count = (FREE_STARTS if without_pose else default_starts(arm, ascent.task)) if starts is None else starts
    blocks = [slice(begin, begin + _BLOCK_POSES) for begin in range(0, len(targets), _BLOCK_POSES)] or [slice(0, 0)]

    def optimise_block(number: int) -> Optimum:
        block_poses = targets[blocks[number]]
        ik_seed, start_seed = np.random.SeedSequence(seed, spawn_key=(number,)).spawn(2)
        if without_pose:
            return optimise_without_pose(ascent, ik_seed, start_count)
        solutions = ascent.engine.solve(block_poses, ik_seed, restarts, scaled_tolerance)
        if initial_q is not None:
            solutions = ascent.engine.prefer_given_configurations(
                solutions, np.atleast_2d(initial_q)[blocks[number]], block_poses, scaled_tolerance
            )
        optimum = ascent.solve(block_poses, solutions, start_seed, start_count, scaled_tolerance)
        tell(len(block_poses))
        return optimum

    with ProgressCount("poses", len(targets), whole=len(blocks) > 4 * thread_count()) as tell:
        if len(blocks) == 1 or in_pool() or thread_count() == 1:
            parts = [optimise_block(block) for block in range(len(blocks))]
        else:
            parts = list(shared_pool().map(optimise_block, range(len(blocks))))
    single = np.ndim(requested) == 2
    arrays = {field.name: np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(Optimum)}
    arrays["q"] = wrap_around_limit_center(arm, arrays["q"])
    return Optima(
        **{name: value[0] if single else value for name, value in arrays.items()},
        objective=objective,
        task=ascent.task,
        free=without_pose,
        poses=arm.forward_kinematics(arrays["q"][0]) if without_pose else targets[0] if single else targets,
        initial=initial_q,
        clearance=resolved_clearance,
        margin=margin,
        seed=seed,
    )
