"""Ascent to the best configuration of a pose, for the worst failure, without moving the end effector.

Source: Abdi, Maciejewski, Nahavandi 2012, eq. (11), (12), in the epigraph form: ``max t`` subject to ``s_k(q) >= t`` for
every failure k, the pose and the joint limits. Each step solves that program linearised about q on the self-motion manifold,
within a trust region. Many starts run at once, and poor ones are dropped early.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.errors import TaskError
from holdfast.core.progress import track
from holdfast.core.status import Status, require_ok
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import damped_least_norm, dot_product, factor_householder
from holdfast.kernels.program import SX
from holdfast.kinematics.indices.objective import Objective
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.inverse_kinematics import (
    InverseKinematics,
    PoseSolutions,
    clip_to_limits,
    solver,
    task_error_and_jacobian,
)
from holdfast.kinematics.solvers.maximin import maximin_step
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task

if TYPE_CHECKING:
    from holdfast.model.collision.clearance import Clearance


_MORE_WAVES = 7  # of random starts, for poses that fewer than half of a wave reached
FIRST_STEPS = 4  # steps of every start
LAST_STEPS = 12  # steps of the few starts that are kept
_RETAINED_STARTS = 4
INITIAL_RADIUS = 0.3  # first step along each null-space direction, rad or m
_MAX_RADIUS = 0.6


@dataclass(frozen=True, kw_only=True)
class Optimum:
    """Best configurations found for N poses, or for one (without the leading N).

    Attributes:
        q: (N, n) configurations, rad and m, within limits; NaN if no configuration of the pose was found.
        value: (N,) value of the objective, never worse than ``start_value``.
        start_value: (N,) value at the first configuration that inverse kinematics found, the sample before optimisation.
        start_q: (N, n) that configuration, or the closest one if none was found.
        status: (N,) ``OK``, ``NOT_FOUND``, ``SINGULAR`` (only singular configurations), ``INFEASIBLE`` (every configuration
            found collides with the arm itself or the cell), ``UNDEFINED`` (a user-defined formula has no value at any
            configuration found) or ``BAD_INPUT``.
        position_error: (N,) position error, m.
        rotation_error: (N,) orientation error, rad.
        starts: (N,) number of starts from which a configuration of the pose was found.
        agreeing: (N,) fraction of the refined starts that reached the best value to 1e-3 of the scale of values.
        blocked: (N,) True if a clearance was requested and the best configuration without it collides.
        blocked_by: (N,) position in ``clearance.pair_names`` of the pair with the smallest margin there or, for the status
            INFEASIBLE, of the pair that most often has the smallest margin; else -1.
    """

    q: FloatArray
    value: FloatArray
    start_value: FloatArray
    start_q: FloatArray
    status: NDArray[np.uint8]
    position_error: FloatArray
    rotation_error: FloatArray
    starts: IndexArray
    agreeing: FloatArray
    blocked: BoolArray
    blocked_by: IndexArray

    @property
    def success(self) -> BoolArray:
        """Flags (N,) of the poses that are reached."""
        return np.asarray((self.status == Status.OK) | (self.status == Status.SINGULAR))

    def require_ok(self) -> Self:
        """Return the result, or raise :class:`holdfast.HoldfastError`, which names the first row that failed."""
        require_ok(self.status, "optimisation")
        return self


def ascent_step(
    objective: Objective,
    task: Task,
    clearance: Clearance | None = None,
    margin: float = 0.0,
    around: bool = False,
    free: bool = False,
) -> tuple[list[SX], SX]:
    """Build one step of the ascent for an arm whose geometry may be symbolic.

    Args:
        objective: Objective to improve.
        task: Rows of the pose to keep.
        clearance: Collision model of the arm with itself.
        margin: Smallest clearance, m.
        around: There are objects as well. Their clearance is an input, so that no step is compiled for a cell.
        free: No pose is kept, so that every joint may move.

    Returns:
        Symbols of the configuration (n,), the trust radius, the last step (n,), the pose, position (3,) and rotation (3, 3),
        and, with objects, their clearance, m, and its gradient (n,); and the next values of the first three as one column.
    """
    arm = objective.arm
    q = kinematics.joint_symbols(arm)
    position, rotation, radius = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3), ca.SX.sym("radius")
    last_move = ca.SX.sym("last", arm.n)
    jacobian = kinematics.invariant_jacobian(arm, q) if task.invariant else task.jacobian(arm, q)
    factorization = factor_householder(jacobian)
    rows = [ca.horzsplit(x) for x in ca.vertsplit(ca.SX.eye(arm.n))] if free else factorization.null_space_basis()
    directions = [ca.vertcat(*column) for column in zip(*rows, strict=True)]
    parts = objective.parts(q, jacobian, factorization, directions)
    # Back onto the pose with least norm. The step along the manifold leaves the pose only to second order.
    error, error_jacobian = task_error_and_jacobian(arm, task, q, position, rotation)
    correction = ca.SX.zeros(arm.n) if free else damped_least_norm(error_jacobian, error, 1e-12)
    no_limit = 1e3  # means no limit: far beyond any trust region
    constraint_rows: list[list[SX]] = []
    constraint_bounds: list[tuple[SX, SX]] = []
    for joint, (lower, upper) in enumerate(zip(arm.lower, arm.upper, strict=True)):
        if kinematics.is_limit_given(lower) or kinematics.is_limit_given(upper):
            lower_room = lower - q[joint] - correction[joint] if kinematics.is_limit_given(lower) else ca.SX(-no_limit)
            upper_room = upper - q[joint] - correction[joint] if kinematics.is_limit_given(upper) else ca.SX(no_limit)
            constraint_rows.append(rows[joint])
            constraint_bounds.append((lower_room, upper_room))
    outside = [ca.SX.sym("gap"), ca.SX.sym("slope", arm.n)] if around else []
    clearances = [] if clearance is None or not clearance.pairs else [clearance.smallest_with_slopes(q, directions)]
    clearances += [(outside[0], [ca.dot(outside[1], direction) for direction in directions])] if outside else []
    if clearances:
        distance, gradient = clearances[0]
        for other_distance, other_gradient in clearances[1:]:
            gradient = [ca.if_else(other_distance < distance, x, y) for x, y in zip(other_gradient, gradient, strict=True)]
            distance = ca.if_else(other_distance < distance, other_distance, distance)
        constraint_rows.append(gradient)
        constraint_bounds.append((margin - distance, ca.SX(no_limit)))
    z = maximin_step(
        parts,
        constraint_rows,
        [lower_room for lower_room, _ in constraint_bounds],
        [upper_room for _, upper_room in constraint_bounds],
        radius,
    )
    move = [dot_product(rows[joint], z) for joint in range(arm.n)]
    next_q = clip_to_limits(arm, [q[joint] + correction[joint] + move[joint] for joint in range(arm.n)])
    # Steps in the same direction may grow; steps that reverse have passed the best point.
    displacement = ca.vertcat(*move)
    cosine = ca.dot(displacement, last_move) / (ca.sqrt(ca.sumsqr(displacement) * ca.sumsqr(last_move)) + 1e-30)
    next_radius = radius * ca.if_else(cosine < 0, 0.5, ca.if_else(cosine > 0.5, 1.3, 0.85))
    next_radius = ca.if_else(next_radius > _MAX_RADIUS, _MAX_RADIUS, next_radius)
    return [q, radius, last_move, position, rotation, *outside], ca.vertcat(next_q, next_radius, displacement)


@cached_kernel
def compile_ascent_step(
    objective: Objective, task: Task, clearance: Clearance | None, margin: float, around: bool, free: bool
) -> Kernel:
    """Compile :func:`ascent_step`; numbers that the objective computes outside are the last input."""
    inputs, step = ascent_step(objective, task, clearance, margin, around, free)
    measured = objective.measured
    return Kernel(f"ascent of {objective.name}", [*inputs, *([] if measured is None else [measured])], [step])


class Ascent:
    """Compiled step of one objective: towards the best configuration, back onto the pose, within the limits.

    If the task leaves no redundancy, the best of the configurations found is chosen. A free ascent keeps no pose
    (:mod:`holdfast.kinematics.solvers.free_pose`).
    """

    def __init__(
        self, objective: Objective, task: Task, clearance: Clearance | None = None, margin: float = 0.0, free: bool = False
    ) -> None:
        self.objective, self.task, self.arm = objective, task, objective.arm
        self.clearance, self.margin, self.free = clearance, margin, free
        self.engine: InverseKinematics = solver(self.arm, task)
        if not free:
            _ = self._step  # an objective that cannot be optimised raises its error before any computation

    @cached_property
    def _step(self) -> Kernel | None:
        if self.arm.n <= self.task.m and not self.free:
            return None
        return compile_ascent_step(self.objective, self.task, None, 0.0, False, self.free)

    @cached_property
    def _collision_free_step(self) -> Kernel:
        """Kernel of the step that also keeps the arm collision-free, compiled at first use and reused for a changed cell."""
        assert self.clearance is not None
        around = self.clearance.obstacles is not None
        return compile_ascent_step(self.objective, self.task, self.clearance.self_only, self.margin, around, self.free)

    def ascend(
        self, collision_free: bool, q: FloatArray, poses: FloatArray, steps: int, radius: FloatArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Take steps from q (N, n); return the ends and the last trust radius."""
        n = self.arm.n
        trust_radius = np.full(len(q), INITIAL_RADIUS) if radius is None else radius
        if self._step is None:
            return q, trust_radius
        step = self._collision_free_step if collision_free else self._step
        obstacles = self.clearance.obstacles if collision_free and self.clearance is not None else None
        state = np.concatenate([q, trust_radius[:, None], np.zeros_like(q)], axis=1)
        positions, rotations = np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
        for _ in track("steps of the ascent", range(steps)):
            previous = state
            extra_inputs = [] if self.objective.measured is None else [self.objective.measure(state[:, :n])]
            if obstacles is not None:
                margin, _, gradient = obstacles.nearest_margin_and_gradient(state[:, :n])
                extra_inputs = [margin, gradient, *extra_inputs]
            state = step.rows(state[:, :n], state[:, n], state[:, n + 1 :], positions, rotations, *extra_inputs)
            # A step with a division by zero (at a singular configuration) is not taken.
            is_invalid = ~np.isfinite(state).all(axis=1)
            state[is_invalid] = previous[is_invalid]
        return state[:, :n], state[:, n]

    def values_to_maximise(self, q: FloatArray) -> FloatArray:
        """Return the objective with its sign set so that larger is better."""
        value = self.objective(q)
        return value if self.objective.better == "larger" else -value

    def _refine_starts(
        self, owner: IndexArray, q: FloatArray, poses: FloatArray, tolerance: float, collision_free: bool
    ) -> tuple[IndexArray, FloatArray, FloatArray]:
        """Ascend from starts q of poses ``owner`` and drop the poor ones; return owners, ends, and oriented values.

        The value is -inf if the end is not on its pose or, if requested, not collision-free.
        """
        q, radius = self.ascend(collision_free, q, poses[owner], FIRST_STEPS)
        value = self.values_to_maximise(q)
        retained = largest_per_group(
            owner, np.where(self.is_collision_free(q), value, -np.inf) if collision_free else value, _RETAINED_STARTS
        )
        owner, q, radius = owner[retained], q[retained], radius[retained]
        q, _ = self.ascend(collision_free, q, poses[owner], LAST_STEPS, radius)
        # Far below the tolerance, so that the value does not improve by leaving the pose.
        q, _ = self.engine.attempt(q, poses[owner], 1e-3 * tolerance)
        q = joint_space.wrap_joints(self.engine.arm, q)
        is_valid = self.engine.check_solutions(q, poses[owner], tolerance)
        if collision_free:
            is_valid &= self.is_collision_free(q)
        return owner, q, np.where(is_valid, self.values_to_maximise(q), -np.inf)

    def is_collision_free(self, q: FloatArray) -> BoolArray:
        """Return (N,) True where q (N, n) respects the margin."""
        assert self.clearance is not None
        return np.asarray(self.clearance.margin_left(q) >= self.margin)

    def _most_frequent_nearest_pair(self, owner: IndexArray, q: FloatArray, poses: IndexArray) -> IndexArray:
        """Return for each pose (H,) the pair that most often has the smallest margin among its configurations q (K, n)."""
        assert self.clearance is not None
        is_selected = np.isin(owner, poses)
        votes = np.zeros((len(poses), len(self.clearance.pair_names)), dtype=np.int64)
        np.add.at(votes, (np.searchsorted(poses, owner[is_selected]), self.clearance.closest_pair(q[is_selected])), 1)
        return np.asarray(votes.argmax(axis=1), dtype=np.int64)

    def _sample_starts(
        self, poses: FloatArray, first: PoseSolutions, seed: np.random.SeedSequence, starts: int, tolerance: float
    ) -> tuple[IndexArray, FloatArray]:
        """Sample start configurations of the reached poses; return the pose of each and the configurations.

        If joint limits let few random starts converge, further waves of starts follow, so that hard poses are searched as well
        as easy ones. Start k of pose i does not depend on the other poses.
        """
        reached = np.flatnonzero(first.success)
        owners, starts_found = [reached], [first.q[reached]]
        converged = first.success.astype(np.int64)
        for wave_index, child_seed in enumerate([seed, *seed.spawn(_MORE_WAVES)]):
            start_count = starts - 1 if wave_index == 0 else starts
            random_q = self.engine.sample_starts(len(poses) * start_count, np.random.default_rng(child_seed)).reshape(
                len(poses), start_count, self.arm.n
            )
            poses_left = reached if wave_index == 0 else reached[converged[reached] < starts // 2]
            if not poses_left.size:
                break
            owner = np.tile(poses_left, start_count)
            q, has_converged = self.engine.attempt(
                random_q[poses_left].transpose(1, 0, 2).reshape(-1, self.arm.n), poses[owner], tolerance
            )
            owners.append(owner[has_converged])
            starts_found.append(q[has_converged])
            converged += np.bincount(owner[has_converged], minlength=len(poses))
        return np.concatenate(owners), np.concatenate(starts_found)

    def solve(
        self, poses: FloatArray, ik_solutions: PoseSolutions, seed: np.random.SeedSequence, starts: int, tolerance: float
    ) -> Optimum:
        """Find the best of several starts for (N, 4, 4) poses.

        Args:
            poses: (N, 4, 4) poses in the world, m.
            ik_solutions: Solutions of inverse kinematics: the first start, and the lower bound of the result.
            seed: Seed of the other starts.
            starts: Total number of starts, with the first one.
            tolerance: Largest pose error, rad, and lengths in units of the arm's own length.
        """
        count = len(poses)
        engine, sign = self.engine, 1.0 if self.objective.better == "larger" else -1.0
        reached = np.flatnonzero(ik_solutions.success)
        best_q = np.where(ik_solutions.success[:, None], ik_solutions.q, np.nan)
        best_value, agreeing = np.full(count, np.nan), np.full(count, np.nan)
        start_counts, blocked = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=bool)
        blocked_by = np.full(count, -1, dtype=np.int64)
        status = ik_solutions.status.copy()
        if reached.size:
            best_value[reached] = self.values_to_maximise(ik_solutions.q[reached])
        start_value = sign * best_value
        if reached.size:
            owner, q = self._sample_starts(poses, ik_solutions, seed, starts, tolerance)
            start_counts = np.bincount(owner, minlength=count)

            def choose_best(owner: IndexArray, q: FloatArray, value: FloatArray, chosen: IndexArray) -> None:
                best_index = largest_per_group(owner, value, 1)
                # A user-defined formula may have no value at the first configuration, so that any other is better.
                best_index = best_index[(value[best_index] > -np.inf) & ~(value[best_index] <= best_value[owner[best_index]])]
                best_q[owner[best_index]], best_value[owner[best_index]] = q[best_index], value[best_index]
                first_value = sign * start_value
                # Either may be infinite, at a singular configuration or by a user-defined formula.
                gain = np.subtract(
                    best_value, first_value, out=np.zeros(count), where=np.isfinite(best_value) & np.isfinite(first_value)
                )
                tolerance_scale = np.where(np.isfinite(best_value), np.maximum(np.abs(best_value), np.abs(gain)), 0.0)
                agrees = (value >= best_value[owner] - 1e-3 * tolerance_scale[owner]) & (value > -np.inf)
                agreeing[chosen] = np.bincount(owner, agrees, count)[chosen] / np.maximum(
                    np.bincount(owner, minlength=count)[chosen], 1
                )

            choose_best(*self._refine_starts(owner, q, poses, tolerance, collision_free=False), reached)
            if self.clearance is not None:
                blocked[reached] = ~self.is_collision_free(best_q[reached])
                blocked_poses = np.flatnonzero(blocked)
                if blocked_poses.size:
                    blocked_by[blocked_poses] = self.clearance.closest_pair(best_q[blocked_poses])
                    # Only poses whose best configuration collides are optimised again.
                    best_value[blocked_poses], best_q[blocked_poses], agreeing[blocked_poses] = -np.inf, np.nan, 0.0
                    is_candidate = blocked[owner]
                    is_candidate[is_candidate] = self.is_collision_free(q[is_candidate])
                    if is_candidate.any():
                        choose_best(
                            owner[is_candidate], q[is_candidate], self.values_to_maximise(q[is_candidate]), blocked_poses
                        )
                        choose_best(
                            *self._refine_starts(owner[is_candidate], q[is_candidate], poses, tolerance, collision_free=True),
                            blocked_poses,
                        )
                    hopeless = blocked_poses[best_value[blocked_poses] == -np.inf]
                    status[hopeless] = Status.INFEASIBLE
                    best_value[best_value == -np.inf] = np.nan
                    blocked_by[hopeless] = self._most_frequent_nearest_pair(owner, q, hopeless)
            feasible = reached[status[reached] != Status.INFEASIBLE]
            statuses = self.objective.row_statuses(best_q[feasible])
            for code in (Status.SINGULAR, Status.UNDEFINED):
                status[feasible[statuses == code]] = code
        position_error, rotation_error = engine.position_and_rotation_errors(best_q, poses)
        return Optimum(
            q=best_q,
            value=sign * best_value,
            start_value=start_value,
            start_q=ik_solutions.q,
            status=status,
            position_error=position_error,
            rotation_error=rotation_error,
            starts=start_counts,
            agreeing=agreeing,
            blocked=blocked,
            blocked_by=blocked_by,
        )


def default_starts(arm: Arm, task: Task) -> int:
    """Return the default number of random starts per pose.

    One degree of redundancy gives curves, often many short ones between joint limits, and only a start on a curve can find its
    best point. On a Panda (measured) 32 starts find the best of 600 on 81 % of poses and 128 on 97 %. More redundancy connects
    the curves.
    """
    return 128 if arm.n - task.m <= 1 else 32


def largest_per_group(owner: IndexArray, value: FloatArray, count: int) -> IndexArray:
    """Return the positions of the ``count`` largest values of each group, ordered by group, then by value."""
    order = np.lexsort((-value, owner))
    sorted_owner = owner[order]
    first_index = np.flatnonzero(np.r_[True, sorted_owner[1:] != sorted_owner[:-1]])
    rank = np.arange(len(owner)) - np.repeat(first_index, np.diff(np.r_[first_index, len(owner)]))
    return np.asarray(order[rank < count])


def get_cached_ascent(
    objective: Objective, task: Task | None = None, clearance: Clearance | None = None, margin: float = 0.0, free: bool = False
) -> Ascent:
    """Return the compiled ascent of an objective, made once for each task, clearance and margin; ``free``: without a pose.

    Raises:
        TaskError: The task differs from the objective's own.
    """
    own_task = objective.own_task
    if own_task is not None and task is not None and not own_task.same_rows(task):
        raise TaskError(
            f"{objective.name} is defined for the task '{own_task.name}', not for '{task.name}'; make it for that task"
        )
    chosen = own_task or task or as_task(objective.arm, "pose")
    cached_ascents: dict[object, Ascent] = objective._compiled_ascents
    key = (chosen.rows.tobytes(), chosen.frame, clearance, margin, free)
    if key not in cached_ascents:
        cached_ascents[key] = Ascent(objective, chosen, clearance, margin, free)
    return cached_ascents[key]
