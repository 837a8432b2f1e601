"""Estimate of the workspace that remains once joints are locked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.probability.intervals import Interval, WeightSums
from holdfast.core.progress import ProgressCount
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.regions.region import Region
from holdfast.model.collision.clearance import Clearance
from holdfast.model.failure_modes import Degraded
from holdfast.response.recovery.task_rows import RowSolver

STARTS_PER_TARGET = 48  # random starts of inverse kinematics per target


@dataclass(frozen=True, kw_only=True)
class RemainingWorkspace(Result):
    """Fraction of targets that are still reached with joints locked.

    A target counts as reached if a configuration is found in ``starts`` random starts, so the fraction is a lower bound.

    Attributes:
        left: Fraction of the targets of the healthy arm that are still reached, with its Clopper-Pearson 95 % interval; None if
            the healthy arm reaches none.
        of_region: Fraction of all poses of the region that are still reached; None without a region.
        healthy_of_region: Fraction of all poses of the region that the healthy arm reaches; None without a region.
        region: Name of the sampled region.
        degraded: Failed arm, with locks and reduced ranges.
        rows: Names of the rows of the target that must be met.
        position: (N, 3) positions of the targets in the world, m.
        healthy: (N,) True where the healthy arm reaches the target.
        locked: (N,) True where the failed arm reaches the target.
        starts: Random starts per target.
    """

    left: Interval | None
    of_region: Interval | None
    healthy_of_region: Interval | None
    region: str
    degraded: Degraded
    rows: tuple[str, ...]
    position: FloatArray
    healthy: BoolArray
    locked: BoolArray
    starts: int


def estimate_remaining_workspace(
    solver: RowSolver,
    degraded: Degraded,
    clearance: Clearance | None,
    margin: float,
    region: Region | None,
    samples: int,
    seed: int,
) -> RemainingWorkspace:
    """Sample targets and count those that are still reached.

    Args:
        solver: Solver of the rows that must be met, within the limits in force.
        degraded: Failed arm.
        clearance: Collision model that keeps at least ``margin``. None: collisions are not checked.
        margin: Smallest clearance, m.
        region: Region of the targets. None: poses of random configurations of the healthy arm.
        samples: Number of targets.
        seed: Seed of the random numbers.
    """
    arm, is_free = degraded.arm, degraded.moves
    failed_solver, solver = solver, solver.with_limits(arm)
    q_locked = np.where(is_free, 0.0, degraded.lo)
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(1,)))
    weights, heaviest = np.ones(samples), 0.0 if region is None else region.heaviest
    if region is None:
        poses = arm.forward_kinematics(_sample_healthy(solver, clearance, margin, samples, rng))
        healthy, name = np.ones(len(poses), dtype=bool), "poses of random configurations"
        weights = weights[: len(poses)]
    else:
        sampled_rows = _sample_region(region, samples, seed)
        if region.kind == "joints":
            poses = arm.forward_kinematics(sampled_rows)
        else:
            poses, weights = region.poses(sampled_rows), region.weights(sampled_rows)
        healthy = _find_reached_poses(solver, poses, q_locked, np.ones(arm.n, dtype=bool), clearance, margin, rng)
        name = region.name
    locked = healthy.copy()
    locked[healthy] = _find_reached_poses(failed_solver, poses[healthy], q_locked, is_free, clearance, margin, rng)
    return RemainingWorkspace(
        left=_estimate_fraction(weights[healthy], locked[healthy], heaviest) if healthy.any() else None,
        of_region=None if region is None else _estimate_fraction(weights, locked, heaviest),
        healthy_of_region=None if region is None else _estimate_fraction(weights, healthy, heaviest),
        region=name,
        degraded=degraded,
        rows=solver.rows.names,
        position=poses[:, :3, 3],
        healthy=healthy,
        locked=locked,
        starts=STARTS_PER_TARGET,
    )


def _estimate_fraction(weights: FloatArray, is_hit: BoolArray, max_weight: float) -> Interval:
    if (weights == weights[0]).all():
        return Interval.from_counts(int(is_hit.sum()), len(is_hit))
    weight_sums = WeightSums(largest=max_weight)
    weight_sums.add(weights)
    fraction = min(float(weights[is_hit].sum() / weight_sums.weight), 1.0)
    return Interval.of_share(fraction, weight_sums.effective_size)


def _sample_healthy(
    solver: RowSolver, clearance: Clearance | None, margin: float, samples: int, rng: np.random.Generator
) -> FloatArray:
    """Sample configurations of the healthy arm, collision-free ones if requested; fewer than ``samples`` if hardly any is."""
    all_joints = np.ones(solver.arm.n, dtype=bool)
    configurations = np.zeros((0, solver.arm.n))
    for _ in range(20):
        q = solver.sample_configurations(samples, np.zeros(solver.arm.n), all_joints, rng)
        configurations = np.concatenate([configurations, q if clearance is None else q[clearance.margin_left(q) >= margin]])
        if len(configurations) >= samples:
            break
    return configurations[:samples]


def _sample_region(region: Region, samples: int, seed: int) -> FloatArray:
    blocks, count = [], 0
    for block in region.blocks(0, seed, count=samples):
        blocks.append(block.copy())
        count += len(block)
        if count >= samples:
            break
    return np.concatenate(blocks)[:samples]


def _find_reached_poses(
    solver: RowSolver,
    poses: FloatArray,
    q_locked: FloatArray,
    free: BoolArray,
    clearance: Clearance | None,
    margin: float,
    rng: np.random.Generator,
) -> BoolArray:
    """Return (N,) True where a random start leads to a configuration of the pose that respects limits and clearance."""
    is_reached = np.zeros(len(poses), dtype=bool)
    used_starts, batch_starts = 0, 2
    with ProgressCount("starts of each pose", STARTS_PER_TARGET, most=True) as add_progress:
        while used_starts < STARTS_PER_TARGET and not is_reached.all():
            unreached = np.flatnonzero(~is_reached)
            pose_indices = np.repeat(unreached, batch_starts)
            row_masks = np.ones((len(pose_indices), solver.rows.m))
            q = solver.solve(
                solver.sample_configurations(len(pose_indices), q_locked, free, rng), poses[pose_indices], row_masks, free
            )
            is_valid = solver.meets_rows(q, poses[pose_indices], row_masks, free)
            if clearance is not None:
                indices = np.flatnonzero(is_valid)
                is_valid[indices] = clearance.margin_left(q[indices]) >= margin
            is_reached[pose_indices[is_valid]] = True
            used_starts += batch_starts
            add_progress(batch_starts)
            batch_starts = min(2 * batch_starts, STARTS_PER_TARGET - used_starts)
    return is_reached
