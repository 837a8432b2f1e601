"""Places (tool poses) at which motions start or end, as lattices, lists, or random samples, and configurations at them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError, TaskError
from holdfast.core.extras import import_extra
from holdfast.core.labels import is_count
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.kinematics.solvers import joint_space
from holdfast.kinematics.solvers.curve_tracing import CURVE_TOLERANCE, Component
from holdfast.kinematics.solvers.inverse_kinematics import solver
from holdfast.kinematics.solvers.self_motions import fibres
from holdfast.model.arm.model import Arm
from holdfast.model.arm.poses import check_poses
from holdfast.model.arm.task import Task

if TYPE_CHECKING:
    import xarray as xr

    from holdfast.kinematics.solvers.self_motions import SelfMotion


LATTICE_POINTS = 52  # points along an edge: 2032 inside the circle
# Spacing of traced self-motions, rad, and number of starts of inverse kinematics for each place.
_CURVE_SPACING_RAD = 0.1
_SEED_STARTS = 48
_TRIES_PER_CONFIGURATION = 8  # random starts of inverse kinematics for each requested configuration


@dataclass(frozen=True, eq=False)
class Places:
    """Set of P tool poses at which motions start or end.

    Attributes:
        poses: (P, 4, 4) tool poses in the world, m; only the rows of the task count.
        cells: (P, 2) column and row of each place in a lattice, from 0; None if the places are not a lattice.
        axes: Coordinates (C,) of the columns and rows of the lattice along the task's two rows, m; None without a lattice.
    """

    poses: FloatArray
    cells: IndexArray | None = None
    axes: tuple[FloatArray, FloatArray] | None = None

    def __len__(self) -> int:
        return len(self.poses)

    @property
    def points(self) -> FloatArray:
        """(P, 3) tool points in the world, m."""
        return self.poses[:, :3, 3]

    def dataset(self, values: Mapping[str, Any], **names: Sequence[str]) -> xr.Dataset:
        """Return values over the dimension ``place``, with the tool points as coordinates x, y, and z, m.

        Args:
            values: Variables of the data set, as pairs of dimensions and values, by name.
            names: Labels along further dimensions, by the name of the dimension.

        Raises:
            HoldfastError: xarray is not installed (extra ``xarray``).
        """
        xr = import_extra("xarray", "xarray")

        points = {axis: ("place", values_m, {"units": "m"}) for axis, values_m in zip("xyz", self.points.T, strict=True)}
        return xr.Dataset(values, {**points, **{name: list(labels) for name, labels in names.items()}})


def is_planar_position(task: Task) -> bool:
    """Return True if the task is the position in a plane, for which places can form a lattice."""
    return task.m == 2 and not task.angular and task.frame == "base"


def make_lattice(arm: Arm, task: Task, count: int = LATTICE_POINTS) -> Places:
    """Make a square lattice over the disc that a planar arm could reach without limits, with ``count`` points along an edge.

    With 52 points along the edge of the square around the disc, exactly 2032 lie inside the disc, as in the paper.

    Raises:
        TaskError: The task is not the position in a plane.
        InputError: There are fewer than 2 points.
    """
    if not is_planar_position(task):
        raise TaskError(f"task '{task.name}' is not the position in a plane, so there is no lattice; give places or a number")
    if count < 2:
        raise InputError(f"a lattice cannot have {count} points along its edge; give 2 or more")
    reach = sum(float(np.linalg.norm(joint.origin[:3, 3])) for joint in arm.joints[1:]) + float(np.linalg.norm(arm.tool[:3, 3]))
    center = arm.frames_at_zero[0, :3, 3]
    coordinates = np.linspace(-reach, reach, count)
    row, column = (grid.ravel() for grid in np.meshgrid(np.arange(count), np.arange(count), indexing="ij"))
    inside = np.hypot(coordinates[column], coordinates[row]) <= reach * (1 + 1e-12)
    row, column = row[inside], column[inside]
    rows = task.rows[:, :3]
    points = center + np.stack([coordinates[column], coordinates[row]], axis=1) @ rows
    x_axis, y_axis = (coordinates + float(center @ component) for component in rows)
    return Places(_make_poses(points), np.stack([column, row], axis=1), (x_axis, y_axis))


def sample_places(arm: Arm, count: int, generator: np.random.Generator) -> Places:
    """Sample the tool poses at ``count`` random configurations, uniform within the joint limits."""
    from holdfast.model.arm.configurations import sampling_limits

    lower, upper = sampling_limits(arm)
    return Places(arm.forward_kinematics(generator.uniform(lower, upper, (count, arm.n))))


def read_places(arm: Arm, task: Task, given: ArrayLike | str | int | Places, generator: np.random.Generator) -> Places:
    """Read places in any accepted form: ``"grid:52"``, a number of random ones, (P, m) positions, or (P, 4, 4) poses.

    Raises:
        InputError: The places have none of these forms.
        TaskError: A lattice was requested for a task that has none.
    """
    if isinstance(given, Places):
        return given
    if isinstance(given, str):
        kind, _, count = given.partition(":")
        if kind != "grid" or not is_count(count or "0"):
            raise InputError(f"places '{given}' are not known; give grid, grid:52, a number, or an array of positions or poses")
        return make_lattice(arm, task, int(count or LATTICE_POINTS))
    if isinstance(given, (int, np.integer)):
        if given < 1:
            raise InputError(f"there cannot be {given} places; give 1 or more")
        return sample_places(arm, int(given), generator)
    values = np.asarray(given, dtype=np.float64)
    if values.ndim in (2, 3) and values.shape[-2:] == (4, 4):
        poses = check_poses(values)
    elif task.angular or task.frame != "base" or values.ndim not in (1, 2) or values.shape[-1] != task.m:
        required_shape = "(P, 4, 4)" if task.angular or task.frame != "base" else f"(P, {task.m}) or (P, 4, 4)"
        raise InputError(f"places have shape {values.shape}; task '{task.name}' takes {required_shape}")
    else:
        poses = _make_poses(np.atleast_2d(values) @ task.rows[:, :3])
    if not len(poses):
        raise InputError("there are no places; give 1 or more")
    if not np.isfinite(poses).all():
        index = int(np.flatnonzero(~np.isfinite(poses).all(axis=(1, 2)))[0])
        raise InputError(f"place {index} holds NaN or infinity; give finite numbers")
    return Places(poses)


def _make_poses(points: FloatArray) -> FloatArray:
    poses = np.tile(np.eye(4), (len(points), 1, 1))
    poses[:, :3, 3] = points
    return poses


# ---- configurations at places ------------------------------------------------------------------------------------


def configurations_at(arm: Arm, task: Task, places: FloatArray, *, count: int, seed: int) -> tuple[IndexArray, FloatArray]:
    """Find configurations at places.

    With one degree of redundancy the configurations are equally spaced in joint space along every curve of the self-motion
    that was found. Otherwise they are random. A place out of reach has none.

    Args:
        arm: The arm; limits of joints that can make a full turn do not count.
        task: Rows of the pose that the configurations must reach.
        places: (P, 4, 4) poses of the end effector in the base frame, m.
        count: Number of configurations on each curve, or largest number of random configurations at each place.
        seed: Seed of the random starts.

    Returns:
        (R,) index from 0 of the place of each configuration, in ascending order, and (R, n) configurations, rad and m.

    Source: Goel et al. 2005, section on the analysis of a workspace.
    """
    arm = arm.without_idle_limits
    if arm.n - task.m == 1:
        owner, guess = sample_self_motions(
            arm, fibres(arm, places, task, spacing=_CURVE_SPACING_RAD, seed=seed, starts=_SEED_STARTS), count
        )
        q, is_solved = solver(arm, task).attempt(guess, places[owner], CURVE_TOLERANCE)
        return owner[is_solved], q[is_solved]
    ik_solver = solver(arm, task)
    generator = np.random.default_rng(seed)
    random_starts = ik_solver.sample_starts(len(places) * count * _TRIES_PER_CONFIGURATION, generator).reshape(
        len(places), count * _TRIES_PER_CONFIGURATION, arm.n
    )
    owner, solutions = np.empty(0, dtype=np.intp), np.empty((0, arm.n))
    used_starts, missing = 0, np.full(len(places), count)
    while used_starts < count * _TRIES_PER_CONFIGURATION and missing.any():
        open_places = np.flatnonzero(missing)
        wave_size = min(count, count * _TRIES_PER_CONFIGURATION - used_starts)
        place_rows = np.repeat(open_places, wave_size)
        q, is_solved = ik_solver.attempt(
            random_starts[open_places, used_starts : used_starts + wave_size].reshape(-1, arm.n),
            places[place_rows],
            CURVE_TOLERANCE,
        )
        is_solved &= np.cumsum(is_solved.reshape(-1, wave_size), axis=1).ravel() <= missing[place_rows]
        owner, solutions = np.concatenate([owner, place_rows[is_solved]]), np.concatenate([solutions, q[is_solved]])
        missing -= np.bincount(place_rows[is_solved], minlength=len(places))
        used_starts += wave_size
    order = np.argsort(owner, kind="stable")
    return owner[order], joint_space.wrap_joints(arm, solutions[order])


def sample_self_motions(arm: Arm, motions: list[SelfMotion], count: int) -> tuple[IndexArray, FloatArray]:
    """Return the points (R, n) at the middle of ``count`` equal parts of each curve, after the index (R,) of their motion."""
    owner = [number for number, motion in enumerate(motions) for _ in motion.components]
    points = [_space_evenly(arm, component, count) for motion in motions for component in motion.components]
    return np.repeat(np.array(owner, dtype=np.intp), count), np.concatenate([np.empty((0, arm.n)), *points])


def _space_evenly(arm: Arm, curve: Component, count: int) -> FloatArray:
    q = curve.q
    if curve.closed:
        q = np.concatenate([q, q[-1:] + joint_space.joint_difference(arm, q[:1], q[-1:])])
    path_lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1))])
    sample_lengths = (np.arange(count) + 0.5) / count * path_lengths[-1]
    return np.stack([np.interp(sample_lengths, path_lengths, column) for column in q.T], axis=1)


def pick_configurations(
    arm: Arm, task: Task, places: FloatArray, count: int, seed: int, generator: np.random.Generator
) -> tuple[IndexArray, IndexArray, FloatArray]:
    """Sample at most ``count`` configurations at each of the places (P, 4, 4) from those of :func:`configurations_at`.

    Returns:
        (R,) index of the place in ascending order, (R,) number of the configuration at it, and (R, n) configurations.
    """
    owner, configurations = configurations_at(arm, task, places, count=count, seed=seed)
    # The random choice among all points takes some of each curve.
    order = np.lexsort([generator.random(len(owner)), owner])
    owner, configurations = owner[order], configurations[order]
    rank = np.arange(len(owner)) - np.searchsorted(owner, owner)
    is_picked = rank < count
    return owner[is_picked], rank[is_picked], configurations[is_picked]
