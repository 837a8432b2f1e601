"""Failure-tolerant workspace of any arm, at sampled points and for sampled angles of the locked joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.core.errors import TaskError
from holdfast.core.progress import track
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

TARGET_TOLERANCE = 1e-6
_HEALTHY_RESTARTS = 40  # restarts for the healthy arm
_LOCKED_RESTARTS = 20
_SOLUTIONS_PER_POINT = 48  # configurations per point that the search uses
_ASCENT_COUNT = 16
_MAX_ASCENT_ROUNDS = 20
_BOX_SAMPLES = 20_000


@dataclass(frozen=True, eq=False)
class SamplingBox:
    """Box around the workspace of an arm, from which points are sampled.

    Attributes:
        directions: (d, 3) orthonormal directions, world; those of the plane of a planar task, else all three.
        low, high: (d,) limits, m.
        rotation: (3, 3) orientation of the end effector at every point.
    """

    directions: FloatArray
    low: FloatArray
    high: FloatArray
    rotation: FloatArray

    @classmethod
    def from_arm(cls, arm: Arm, task: Task, rotation: FloatArray) -> SamplingBox:
        """Return the box of the tool points of many random configurations, 2 % wider; the random seed is fixed."""
        linear = task.rows[:, :3]
        rank = int(np.linalg.matrix_rank(linear, tol=1e-9)) if len(linear) else 0
        if rank == 3:
            directions = np.eye(3)
        elif task.frame == "base" and rank == 2 and np.allclose(np.linalg.norm(linear[:2], axis=1), 1):
            directions = linear[:2]
        else:
            raise TaskError(f"task '{task.name}' does not hold a point of space or of a plane; use position, planar or pose")
        lower, upper = sampling_limits(arm)
        q = np.random.default_rng(0).uniform(lower, upper, (_BOX_SAMPLES, arm.n))
        tool_points = arm.forward_kinematics(q)[:, :3, 3] @ directions.T
        minimum, maximum = tool_points.min(axis=0), tool_points.max(axis=0)
        return cls(directions, minimum - 0.02 * (maximum - minimum), maximum + 0.02 * (maximum - minimum), rotation)

    @property
    def size(self) -> float:
        """Size of the box, m^2 or m^3."""
        return float(np.prod(self.high - self.low))

    def sample_poses(self, count: int, seed: int) -> FloatArray:
        """Return poses (N, 4, 4) at points of a low-discrepancy sequence."""
        from scipy.stats import qmc

        sequence = qmc.Halton(self.low.size, seed=np.random.default_rng(seed))
        poses = np.tile(np.eye(4), (count, 1, 1))
        poses[:, :3, :3] = self.rotation
        poses[:, :3, 3] = qmc.scale(sequence.random(count), self.low, self.high) @ self.directions
        return poses


def with_artificial_limits(arm: Arm, limits: FloatArray) -> Arm:
    """Return the arm with artificial limits (n, 2); limits of a full turn or more are ignored for a joint without limits."""
    lower, upper = limits.T
    is_unlimited = joint_space.is_unlimited(arm) & (upper - lower >= 2 * np.pi - 1e-9)
    return arm.with_limits(np.where(is_unlimited, arm.lower, lower), np.where(is_unlimited, arm.upper, upper))


def find_reached_poses(arm: Arm, task: Task, poses: FloatArray, seed: int) -> BoolArray:
    """Return (N,) True for poses for which a configuration was found."""
    if not len(poses):
        return np.zeros(0, dtype=bool)
    return solver(arm, task).solve(poses, np.random.SeedSequence(seed), _HEALTHY_RESTARTS, TARGET_TOLERANCE).success


def check_survival(arm: Arm, task: Task, poses: FloatArray, angles: list[FloatArray], seed: int) -> list[BoolArray]:
    """Return for each joint whether each pose was reached (N, K) with the joint locked at each of its angles (K,)."""
    engine, tables = solver(arm, task), []
    for joint, values in enumerate(track("joints locked", angles)):
        rows, columns = np.repeat(np.arange(len(poses)), values.size), np.tile(values, len(poses))
        if not rows.size:
            tables.append(np.zeros((len(poses), values.size), dtype=bool))
            continue
        is_reached = engine.is_reachable_with_lock(
            poses[rows],
            np.full(rows.size, joint),
            columns,
            np.random.SeedSequence([seed, joint]),
            _LOCKED_RESTARTS,
            TARGET_TOLERANCE,
        )
        tables.append(is_reached.reshape(len(poses), values.size))
    return tables


@dataclass
class LimitChoices:
    """Candidate artificial limits of one joint, between values of a grid.

    Attributes:
        limits: (I, 2) candidate limits, rad or m.
        survives: (I, H) True for points reached with the joint locked at every grid value between the limits.
        holds: (I, H, S) True for configurations within the limits.
    """

    limits: FloatArray
    survives: BoolArray
    holds: BoolArray

    @classmethod
    def from_table(cls, grid: FloatArray, is_periodic: bool, table: BoolArray, q: FloatArray) -> LimitChoices:
        """Return the choices of a grid (K,) with its reached values (H, K), and configurations q (H, S), NaN in none."""
        count, step = grid.size, grid[1] - grid[0]
        if is_periodic:
            table = np.tile(table, 2)
            pairs = [(first_index, first_index + span) for first_index in range(count) for span in range(count)]
            pairs.append((0, count))
        else:
            pairs = [(first_index, last_index) for first_index in range(count) for last_index in range(first_index, count)]
        first, last = np.array(pairs).T
        lost_counts = np.concatenate([np.zeros((len(table), 1), dtype=np.int64), np.cumsum(~table, axis=1)], axis=1)
        survives = (lost_counts[:, np.minimum(last + 1, lost_counts.shape[1] - 1)] == lost_counts[:, first]).T
        grid_position = (q - grid[0]) / step
        offsets = grid_position[None] - first[:, None, None]
        offsets = np.mod(offsets, count) if is_periodic else offsets
        holds = (offsets >= 0) & (offsets <= (last - first)[:, None, None])
        return cls(np.stack([grid[0] + step * first, grid[0] + step * last], axis=1), survives, holds)


def find_best_limits(arm: Arm, task: Task, space: SamplingBox, points: int, count: int, seed: int) -> FloatArray:
    """Find artificial limits (n, 2) that contain the most sampled points, by coordinate ascent from many starts.

    The limits of each joint are chosen in turn among all pairs of values of a grid of ``count``, with the other limits fixed,
    as long as points are gained. The result is not proved to be the best.
    """
    generator = np.random.default_rng(np.random.SeedSequence([seed, 1]))
    poses = space.sample_poses(points, seed)
    poses = poses[find_reached_poses(arm, task, poses, seed)]
    lower, upper = _limit_search_range(arm)
    if not len(poses):
        return np.stack([lower, upper], axis=1)
    is_periodic = joint_space.is_unlimited(arm)
    grids = [
        np.linspace(grid_start, grid_end, count + periodic)[:count]
        for grid_start, grid_end, periodic in zip(lower, upper, is_periodic, strict=True)
    ]
    survival_tables = check_survival(arm, task, poses, grids, seed)
    q = find_solutions_per_pose(arm, task, poses, generator)
    choices = [
        LimitChoices.from_table(grid, bool(periodic), joint_table, q[:, :, joint])
        for joint, (grid, periodic, joint_table) in enumerate(zip(grids, is_periodic, survival_tables, strict=True))
    ]
    limits = choose_limits(choices, q, generator)
    return np.stack([lower, upper], axis=1) if limits is None else limits


def choose_limits(choices: list[LimitChoices], q: FloatArray, generator: np.random.Generator) -> FloatArray | None:
    """Choose limits (n, 2) that contain most points, with known q (H, S, n), by coordinate ascent; None without q."""
    best, best_count = list[int](), -1
    known = np.argwhere(~np.isnan(q[:, :, 0]))
    for point, solution in known[generator.integers(0, len(known), _ASCENT_COUNT)] if len(known) else known:
        chosen, point_count = _ascend_coordinates(choices, point, solution, generator)
        if point_count > best_count:
            best, best_count = chosen, point_count
    return np.array([choice.limits[index] for choice, index in zip(choices, best, strict=True)]) if best else None


def _limit_search_range(arm: Arm) -> tuple[FloatArray, FloatArray]:
    """Return the range in which limits are searched; a revolute joint needs at most one turn."""
    lower, upper = sampling_limits(arm)
    exceeds_turn = ~arm.prismatic & (upper - lower > 2 * np.pi)
    middle = (lower + upper) / 2
    return np.where(exceeds_turn, middle - np.pi, lower), np.where(exceeds_turn, middle + np.pi, upper)


def find_solutions_per_pose(arm: Arm, task: Task, poses: FloatArray, generator: np.random.Generator) -> FloatArray:
    """Find configurations (H, S, n) of each pose, NaN where a start did not converge."""
    engine = solver(arm, task)
    rows = np.repeat(np.arange(len(poses)), _SOLUTIONS_PER_POINT)
    q, converged = engine.attempt(engine.sample_starts(rows.size, generator), poses[rows], TARGET_TOLERANCE)
    return np.where(converged[:, None], q, np.nan).reshape(len(poses), _SOLUTIONS_PER_POINT, arm.n)


def _ascend_coordinates(
    choices: list[LimitChoices], point: int, solution: int, generator: np.random.Generator
) -> tuple[list[int], int]:
    """Ascend from narrow limits around one configuration; return each joint's choice and the number of contained points."""
    chosen = []
    for choice in choices:
        width = np.where(choice.holds[:, point, solution], np.diff(choice.limits)[:, 0], np.inf)
        chosen.append(int(np.argmin(width)) if np.isfinite(width).any() else int(np.argmax(np.diff(choice.limits)[:, 0])))
    point_count = -1
    for _ in range(_MAX_ASCENT_ROUNDS):
        previous_count = point_count
        for joint in generator.permutation(len(choices)):
            others = [other for other in range(len(choices)) if other != joint]
            survives = np.all([choices[other].survives[chosen[other]] for other in others], axis=0)
            holds = np.all([choices[other].holds[chosen[other]] for other in others], axis=0)
            survivors = np.flatnonzero(survives & holds.any(axis=1))
            choice = choices[joint]
            score = (choice.survives[:, survivors] & (choice.holds[:, survivors] & holds[survivors]).any(axis=2)).sum(axis=1)
            point_count = int(score.max())
            chosen[joint] = int(generator.choice(np.flatnonzero(score == point_count)))
        if point_count == previous_count:
            break
    return chosen, point_count
