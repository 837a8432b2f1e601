"""The failure-tolerant workspace of any arm, at sampled points and for sampled angles of the locked joint."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.arm.urdf import rpy_rotation
from holdfast.certificates.claims import TolerantClaim
from holdfast.errors import TaskError
from holdfast.notice import each
from holdfast.solvers import joint_space
from holdfast.solvers.inverse_kinematics import solver

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]

TOLERANCE = 1e-6
_RESTARTS = 40  # for the healthy arm
_RESTARTS_LOCKED = 20
_SOLUTIONS = 48  # configurations per point that the search knows
_ASCENTS = 16
_ROUNDS = 20
_BOX_DRAWS = 20_000


@dataclass(frozen=True, eq=False)
class Space:
    """Where points are drawn: a box about what the arm reaches.

    Attributes:
        directions: (d, 3) orthonormal, world; the plane of a planar task, else all three.
        low, high: (d,) m.
        rotation: (3, 3) of the end effector at every point.
    """

    directions: Array
    low: Array
    high: Array
    rotation: Array

    @classmethod
    def of(cls, arm: Arm, task: Task, rotation: Array) -> Space:
        """The box of the tool points of many random configurations, 2 % wider; always the same ones."""
        linear = task.rows[:, :3]
        rank = int(np.linalg.matrix_rank(linear, tol=1e-9)) if len(linear) else 0
        if rank == 3:
            directions = np.eye(3)
        elif task.frame == "base" and rank == 2 and np.allclose(np.linalg.norm(linear[:2], axis=1), 1):
            directions = linear[:2]
        else:
            raise TaskError(f"task '{task.name}' does not hold a point of space or of a plane; use position, planar or pose")
        low, high = finite_limits(arm)
        tool = arm.forward_kinematics(np.random.default_rng(0).uniform(low, high, (_BOX_DRAWS, arm.n)))[:, :3, 3] @ directions.T
        least, most = tool.min(axis=0), tool.max(axis=0)
        return cls(directions, least - 0.02 * (most - least), most + 0.02 * (most - least), rotation)

    @property
    def size(self) -> float:
        """m^2 or m^3."""
        return float(np.prod(self.high - self.low))

    def draw(self, count: int, seed: int) -> Array:
        """Poses (N, 4, 4) at points of a low-discrepancy sequence."""
        from scipy.stats import qmc

        sequence = qmc.Halton(self.low.size, seed=np.random.default_rng(seed))
        poses = np.tile(np.eye(4), (count, 1, 1))
        poses[:, :3, :3] = self.rotation
        poses[:, :3, 3] = qmc.scale(sequence.random(count), self.low, self.high) @ self.directions
        return poses


def limited(arm: Arm, limits: Array) -> Arm:
    """The arm with artificial limits (n, 2); those of a whole turn or more of a joint without limits do not count."""
    low, high = limits.T
    free = joint_space.turning(arm) & (high - low >= 2 * np.pi - 1e-9)
    return arm.with_limits(np.where(free, arm.lower, low), np.where(free, arm.upper, high))


def reached(arm: Arm, task: Task, poses: Array, seed: int) -> Bools:
    """(N,) poses of which a configuration was found."""
    if not len(poses):
        return np.zeros(0, dtype=bool)
    return solver(arm, task).solve(poses, np.random.SeedSequence(seed), _RESTARTS, TOLERANCE).success


def survival(arm: Arm, task: Task, poses: Array, angles: list[Array], seed: int) -> list[Bools]:
    """For each joint (N, K): whether each pose was reached with the joint locked at each of its angles (K,)."""
    engine, made = solver(arm, task), []
    for k, values in enumerate(each("joints locked", angles)):
        rows, columns = np.repeat(np.arange(len(poses)), values.size), np.tile(values, len(poses))
        if not rows.size:
            made.append(np.zeros((len(poses), values.size), dtype=bool))
            continue
        found = engine.reaches_locked(
            poses[rows], np.full(rows.size, k), columns, np.random.SeedSequence([seed, k]), _RESTARTS_LOCKED, TOLERANCE
        )
        made.append(found.reshape(len(poses), values.size))
    return made


@dataclass
class Choices:
    """The artificial limits of one joint that are tried: between values of a grid.

    Attributes:
        limits: (I, 2) rad or m.
        survives: (I, H) points reached with the joint locked at every value of the grid between the limits.
        holds: (I, H, S) configurations within them.
    """

    limits: Array
    survives: Bools
    holds: Bools

    @classmethod
    def of(cls, grid: Array, circle: bool, table: Bools, q: Array) -> Choices:
        """For a grid (K,) of joint values, the reached ones (H, K), and configurations q (H, S); NaN is within none."""
        size, step = grid.size, grid[1] - grid[0]
        if circle:
            table, pairs = np.tile(table, 2), [(a, a + w) for a in range(size) for w in range(size)]
            pairs.append((0, size))
        else:
            pairs = [(a, b) for a in range(size) for b in range(a, size)]
        first, last = np.array(pairs).T
        lost = np.concatenate([np.zeros((len(table), 1), dtype=np.int64), np.cumsum(~table, axis=1)], axis=1)
        survives = (lost[:, np.minimum(last + 1, lost.shape[1] - 1)] == lost[:, first]).T
        cell = (q - grid[0]) / step
        away = np.mod(cell[None] - first[:, None, None], size) if circle else cell[None] - first[:, None, None]
        holds = (away >= 0) & (away <= (last - first)[:, None, None])
        return cls(np.stack([grid[0] + step * first, grid[0] + step * last], axis=1), survives, holds)


def best_limits(arm: Arm, task: Task, space: Space, points: int, count: int, seed: int) -> Array:
    """Artificial limits (n, 2) that hold most of a sample of points, by coordinate ascent from many starts.

    Each joint's limits are chosen in turn among all pairs of values of a grid of ``count``, the others held, as long as points
    are gained. Nothing proves that the best ones are found.
    """
    generator = np.random.default_rng(np.random.SeedSequence([seed, 1]))
    poses = space.draw(points, seed)
    poses = poses[reached(arm, task, poses, seed)]
    low, high = _grid_range(arm)
    if not len(poses):
        return np.stack([low, high], axis=1)
    circle = joint_space.turning(arm)
    grids = [np.linspace(a, b, count + c)[:count] for a, b, c in zip(low, high, circle, strict=True)]
    table = survival(arm, task, poses, grids, seed)
    q = configurations(arm, task, poses, generator)
    choices = [Choices.of(g, bool(c), t, q[:, :, k]) for k, (g, c, t) in enumerate(zip(grids, circle, table, strict=True))]
    found = most_held(choices, q, generator)
    return np.stack([low, high], axis=1) if found is None else found


def most_held(choices: list[Choices], q: Array, generator: np.random.Generator) -> Array | None:
    """Limits (n, 2) that hold most points, of which q (H, S, n) are known, by coordinate ascent; None if none is known."""
    best, most = list[int](), -1
    known = np.argwhere(~np.isnan(q[:, :, 0]))
    for row, column in known[generator.integers(0, len(known), _ASCENTS)] if len(known) else known:
        chosen, gained = _ascend(choices, row, column, generator)
        if gained > most:
            best, most = chosen, gained
    return np.array([c.limits[k] for c, k in zip(choices, best, strict=True)]) if best else None


def _grid_range(arm: Arm) -> tuple[Array, Array]:
    """Between which values limits are looked for: a revolute joint needs no more than one turn."""
    low, high = finite_limits(arm)
    wide = ~arm.prismatic & (high - low > 2 * np.pi)
    middle = (low + high) / 2
    return np.where(wide, middle - np.pi, low), np.where(wide, middle + np.pi, high)


def configurations(arm: Arm, task: Task, poses: Array, generator: np.random.Generator) -> Array:
    """(H, S, n) configurations of each pose, NaN where a start did not converge."""
    engine = solver(arm, task)
    rows = np.repeat(np.arange(len(poses)), _SOLUTIONS)
    q, ok = engine.attempt(engine.starts(rows.size, generator), poses[rows], TOLERANCE)
    return np.where(ok[:, None], q, np.nan).reshape(len(poses), _SOLUTIONS, arm.n)


def _ascend(choices: list[Choices], row: int, column: int, generator: np.random.Generator) -> tuple[list[int], int]:
    """From narrow limits about one configuration: the choice of each joint, and how many points it holds."""
    chosen = []
    for c in choices:
        width = np.where(c.holds[:, row, column], np.diff(c.limits)[:, 0], np.inf)
        chosen.append(int(np.argmin(width)) if np.isfinite(width).any() else int(np.argmax(np.diff(c.limits)[:, 0])))
    gained = -1
    for _ in range(_ROUNDS):
        before = gained
        for k in generator.permutation(len(choices)):
            others = [m for m in range(len(choices)) if m != k]
            survives = np.all([choices[m].survives[chosen[m]] for m in others], axis=0)
            holds = np.all([choices[m].holds[chosen[m]] for m in others], axis=0)
            here = np.flatnonzero(survives & holds.any(axis=1))
            c = choices[k]
            score = (c.survives[:, here] & (c.holds[:, here] & holds[here]).any(axis=2)).sum(axis=1)
            gained = int(score.max())
            chosen[k] = int(generator.choice(np.flatnonzero(score == gained)))
        if gained == before:
            break
    return chosen, gained


def sample_box_poses(claim: TolerantClaim, count: int, seed: int, sample: int) -> Array:
    """Return poses (N, 4, 4) of the corners of a claim's box, and of ``count`` targets inside; each sample is another one."""
    from scipy.stats import qmc

    box = claim.box
    varying = box[:, 0] < box[:, 1]
    corners = np.array(list(product(*([lower, upper] if lower < upper else [lower] for lower, upper in box))))
    inside = np.tile(box[:, 0], (count if varying.any() else 0, 1))
    if varying.any():
        halton = qmc.Halton(int(varying.sum()), rng=np.random.default_rng([seed, sample]))
        inside[:, varying] = qmc.scale(halton.random(len(inside)), *box[varying].T)
    rows = np.vstack([corners, inside])
    position_count = 2 if claim.task.startswith("planar") else 3
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :position_count, 3] = rows[:, :position_count]
    if claim.rotation is not None:
        poses[:, :3, :3] = claim.rotation
    elif rows.shape[1] > position_count:  # of a planar pose yaw alone
        angles = np.zeros((len(rows), 3))
        angles[:, position_count - rows.shape[1] :] = rows[:, position_count:]
        poses[:, :3, :3] = [rpy_rotation(row.tolist()) for row in angles]
    return poses
