"""Best joint motion along a path of the end effector, by dynamic programming over sampled self-motion manifolds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.progress import reports_progress
from holdfast.core.status import Status, require_ok
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.best_paths import BestPathTable, NodeMoves, bound_move_length
from holdfast.kinematics.solvers.self_motions import TRACING_STARTS, SelfMotion, fibres
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

Objective = Callable[[FloatArray], ArrayLike]


@dataclass(frozen=True, eq=False, kw_only=True)
class FibrePath:
    """Configurations along a path of T poses.

    Attributes:
        q: (T, n) one configuration of each pose, rad and m; joints without limits may pass pi. NaN where ``status`` is not OK.
        value: (T,) value of the objective at q.
        global_value: (T,) smallest value over all points of the pose's manifold, even if no path leads there.
        global_q: (T, n) configuration with this value, rad and m.
        gaps: (G,) every index t at which no continuous motion leads from ``q[t]`` to pose t + 1. The best path for the poses up
            to t ends there, and another path begins after it.
        reach: (T - 1,) largest allowed distance in joint space from one pose to the next, rad (and m).
        status: (T,) ``OK``, ``NOT_FOUND`` (no configuration of the pose was found), ``UNDEFINED`` (the objective is NaN or
            infinite at all of them) or ``BAD_INPUT``.
    """

    q: FloatArray
    value: FloatArray
    global_value: FloatArray
    global_q: FloatArray
    gaps: IndexArray
    reach: FloatArray
    status: NDArray[np.uint8]

    @property
    def continuous(self) -> bool:
        """True if one motion leads along the whole path."""
        return not self.gaps.size and bool((self.status == Status.OK).all())

    def require_ok(self) -> FibrePath:
        """Return the path, or raise :class:`holdfast.HoldfastError`, which names the first pose without a configuration."""
        require_ok(self.status, "best path")
        return self


@reports_progress("looking for the best path")
def best_path(
    arm: Arm,
    poses: ArrayLike,
    objective_value: Objective,
    *,
    task: str | Task | Sequence[str] = "pose",
    spacing: float = 0.05,
    rate_limit: ArrayLike | None = None,
    cost: Literal["mean", "max"] = "mean",
    motion: float = 1e-2,
    seed: int = 0,
    starts: int = TRACING_STARTS,
) -> FibrePath:
    """Find the configurations along a path of poses whose objective is smallest, on average or at its largest.

    The result is global up to the spacing and up to curves that no start of inverse kinematics found. Gradient projection
    follows one minimum of the objective; this function also finds a motion that first accepts worse values to reach better ones
    later.

    Args:
        arm: Arm model.
        poses: (T, 4, 4) poses in the world, m, T at least 2, close together.
        objective_value: Function of configurations (N, n) with values (N,), smaller is better, for example a susceptibility.
            NaN forbids a configuration.
        task: Rows of the poses that matter.
        spacing: Distance of the points of each manifold, rad; see :func:`holdfast.kinematics.solvers.fibres`.
        rate_limit: Largest motion of each joint from one pose to the next (speed times time step), rad or m, one number or
            (n,). The spacing is added to it, because the points are no finer. Default: the distance in joint space must be at
            most 3 times the spacing and twice the distance that the points of one manifold typically need to reach the next.
        cost: ``mean`` of the values, or ``max`` to minimise the largest value, and among those paths the mean.
        motion: Weight of the motion. The longest allowed step costs this fraction of the difference between the median and the
            smallest of all values; a step half as long costs a quarter of it.
        seed: Seed of the starts.
        starts: Number of starts of inverse kinematics per pose.

    Returns:
        A :class:`FibrePath`; where no continuous path exists, it reports a gap instead of a jump.

    Raises:
        InputError: There are fewer than 2 poses, the objective has a wrong shape, or an option is out of range.
        TaskError: The arm has no redundancy for the task.
    """
    if np.ndim(poses) != 3 or np.shape(poses)[0] < 2:
        raise InputError(f"poses have shape {np.shape(poses)}; a path needs (T, 4, 4) with T of 2 or more")
    manifolds = fibres(arm, poses, task, spacing=spacing, seed=seed, starts=starts, follow=True)
    return best_path_over(arm, manifolds, objective_value, rate_limit=rate_limit, cost=cost, motion=motion)


def best_path_over(
    arm: Arm,
    found: Sequence[SelfMotion],
    objective_value: Objective,
    *,
    rate_limit: ArrayLike | None = None,
    cost: Literal["mean", "max"] = "mean",
    motion: float = 1e-2,
) -> FibrePath:
    """Find the best path of ``arm`` over ``found``, the self-motion manifolds of its poses (:func:`fibres`, ``follow=True``).

    Several objectives can share the manifolds. ``objective_value``, ``rate_limit`` (rad or m), ``cost`` and ``motion`` are the
    arguments of :func:`best_path`.
    """
    if cost not in ("mean", "max"):
        raise InputError(f"cost is '{cost}'; use 'mean' or 'max'")
    if not (np.isfinite(motion) and motion >= 0):
        raise InputError(f"motion is {motion:g}; it must be 0 or more")
    step_limit = _read_rate_limit(arm, rate_limit)
    points = [manifold.q for manifold in found]
    values = _evaluate_points(objective_value, points)
    moves, reach = zip(
        *(
            _find_moves(arm, before, after, manifold.spacing, step_limit)
            for before, after, manifold in zip(points[:-1], points[1:], found, strict=False)
        ),
        strict=True,
    )
    best = [int(np.argmin(pose_values)) if np.isfinite(pose_values).any() else -1 for pose_values in values]
    finite_values = np.concatenate(values)[np.isfinite(np.concatenate(values))]
    weight = motion * float(np.median(finite_values) - finite_values.min()) if finite_values.size else 0.0
    chosen, gaps = _choose_points_and_gaps(values, moves, weight, cost)

    def take_points(indices: list[int]) -> tuple[FloatArray, FloatArray]:
        """Return the configurations (T, n) with these indices, and their values (T,); NaN where the index is -1."""
        no_configuration, chosen_points = np.full(arm.n, np.nan), list(zip(points, values, indices, strict=True))
        return (
            np.array([pose_points[index] if index >= 0 else no_configuration for pose_points, _, index in chosen_points]),
            np.array([pose_values[index] if index >= 0 else np.nan for _, pose_values, index in chosen_points]),
        )

    q, value = take_points(chosen)
    global_q, smallest = take_points(best)
    status = np.array([manifold.status for manifold in found], dtype=np.uint8)
    status[(np.array(best) < 0) & (status == Status.OK)] = Status.UNDEFINED
    return FibrePath(
        q=_unwrap_path(arm, q),
        value=value,
        global_value=smallest,
        global_q=global_q,
        gaps=np.array(gaps, dtype=np.int64),
        reach=np.array(reach),
        status=status,
    )


def _find_moves(
    arm: Arm, before: FloatArray, after: FloatArray, spacing: float, limit: FloatArray | None
) -> tuple[NodeMoves, float]:
    """Return the allowed moves between the points of two manifolds, in units of the largest distance, and this distance."""
    if not len(before) or not len(after):
        return NodeMoves(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64), np.empty(0), np.empty(0)), np.nan
    if limit is None:
        reach = bound_move_length(spacing, joint_space.find_nearest(arm, after, before)[0])
    else:
        reach = float(np.linalg.norm(limit + spacing))
    target_tree = joint_space.build_tree(arm, after)
    pairs = joint_space.build_tree(arm, before).sparse_distance_matrix(target_tree, reach, output_type="ndarray")
    pairs = pairs[np.argsort(pairs["j"], kind="stable")]
    sources, targets, excesses = pairs["i"].astype(np.int64), pairs["j"].astype(np.int64), np.zeros(len(pairs))
    if limit is not None:
        joint_steps = np.abs(joint_space.joint_difference(arm, after[targets], before[sources]))
        excesses = np.where(joint_steps <= limit + spacing, 0.0, np.inf).max(axis=1, initial=0.0)
    return NodeMoves(targets, sources, (pairs["v"] / reach) ** 2, excesses), reach


def _choose_points_and_gaps(
    values: list[FloatArray], moves: Sequence[NodeMoves], weight: float, cost: str
) -> tuple[list[int], list[int]]:
    """Choose a point at each pose (-1: none exists), and return the gaps as well."""
    gains = [-pose_values for pose_values in values]
    chosen: list[int] = [-1] * len(gains)
    gaps: list[int] = []
    t = 0
    while t < len(gains):
        if np.isfinite(gains[t]).any():
            stretch_gains = gains[t:]
            if cost == "max":
                nodes = _find_best_nodes(stretch_gains, moves[t:], 0.0, np.minimum)
                stretch_gains = stretch_gains[: len(nodes)]
                least_gain = min(gain[node] for gain, node in zip(stretch_gains, nodes, strict=True))
                stretch_gains = [np.where(gain >= least_gain, gain, -np.inf) for gain in stretch_gains]
            nodes = _find_best_nodes(stretch_gains, moves[t : t + len(stretch_gains) - 1], weight, np.add)
            chosen[t : t + len(nodes)] = nodes.tolist()
            t += len(nodes) - 1
        if t + 1 < len(gains):
            gaps.append(t)
        t += 1
    return chosen, gaps


def _find_best_nodes(
    gains: list[FloatArray],
    moves: Sequence[NodeMoves],
    weight: float,
    combine_gains: Callable[[FloatArray, FloatArray], FloatArray],
) -> IndexArray:
    """Return the nodes of the best motion from the first pose to the last reachable pose."""
    table = BestPathTable(gains, move_weight=weight, combine_gains=combine_gains)
    for step in moves:
        table.advance_to_next_pose(step)
    return table.trace_best_motion()


def _evaluate_points(objective_value: Objective, points: list[FloatArray]) -> list[FloatArray]:
    """Evaluate the objective at the points of each pose; infinite where it is NaN."""
    all_points = np.concatenate(points)
    value = np.asarray(objective_value(all_points), dtype=np.float64)
    if value.shape != (len(all_points),):
        raise InputError(
            f"the objective gives shape {value.shape} for {len(all_points)} configurations; it must give one value each"
        )
    value = np.where(np.isnan(value), np.inf, value)
    return np.split(value, np.cumsum([len(pose_points) for pose_points in points])[:-1])


def _read_rate_limit(arm: Arm, rate_limit: ArrayLike | None) -> FloatArray | None:
    if rate_limit is None:
        return None
    limit = np.asarray(rate_limit, dtype=np.float64)
    if limit.shape not in ((), (arm.n,)) or not (np.isfinite(limit) & (limit > 0)).all():
        raise InputError(
            f"rate_limit is {limit.tolist()}; it must be one number or {arm.n}, above 0, rad or m from pose to pose"
        )
    return np.broadcast_to(limit, (arm.n,))


def _unwrap_path(arm: Arm, q: FloatArray) -> FloatArray:
    """Make joints without limits take the short way from one pose to the next, also across -pi and pi."""
    displacements = np.nan_to_num(joint_space.joint_difference(arm, q[1:], q[:-1]))
    unbroken: BoolArray = np.asarray(np.isfinite(q).all(axis=1))
    unwrapped = q.copy()
    for t in range(1, len(q)):
        if unbroken[t] and unbroken[t - 1]:
            unwrapped[t] = np.where(joint_space.is_unlimited(arm), unwrapped[t - 1] + displacements[t - 1], q[t])
    return unwrapped
