"""Map of the tool directions in which an arm reaches each cell of its workspace, intact and with each joint locked."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.files.output import replace_file
from holdfast.core.progress import reports_progress, track
from holdfast.core.result import Result
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.core.validation import check_arguments
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import as_task, plane_normal

DEFAULT_SAMPLES = 1_000_000
DEFAULT_BANDS = 3
DEFAULT_LOCK_VALUES = 4
_CELLS_PER_REACH = {2: 40, 3: 12}  # cells between the first joint and the end of the stretched arm, in a plane and in space
_MAX_FLAGS = 2_000_000_000  # bytes
_BATCH_ROWS = 1 << 13  # fits into the cache
_LEAST_HORIZONTAL = 1e-9  # length of the horizontal part of a direction below which its azimuth is only rounding


@dataclass(frozen=True, eq=False, kw_only=True)
class ReachabilityMap(Result):
    """Number of tool directions that an arm reaches in each cell of its workspace, intact and with each joint locked.

    A direction of a cell counts as reached if a sampled configuration has its tool point in the cell and its tool direction
    in the part of the sphere (or circle) that belongs to the direction. The counts are therefore lower bounds.

    Attributes:
        arm: Arm model.
        centers: (V, 3) centres of the cells that the intact arm reaches, m, world.
        cell_size: Edge length of a cell, m.
        directions: Number of directions of each cell.
        reached: (V,) number of directions that the intact arm reaches.
        lock_values: (n, B) values at which each joint is locked, rad and m.
        reached_locked: (V, n, B) number of directions that the arm reaches with the joint locked at the value.
        samples: Number of configurations for the intact arm, and for each lock value of each joint.
        growth: (n,) fraction of the reached directions, by locked joint, that only the second half of the samples found;
            if it is large, more samples would find more.
    """

    arm: Arm
    centers: FloatArray
    cell_size: float
    directions: int
    reached: IndexArray
    lock_values: FloatArray
    reached_locked: IndexArray
    samples: int
    growth: FloatArray

    @property
    def index(self) -> FloatArray:
        """Reachability index (V,) of the intact arm: reached directions divided by all directions."""
        return self.reached / self.directions

    @property
    def locked_index(self) -> FloatArray:
        """Reachability index (V, n) after a lock of each joint, as the mean over its lock values."""
        return np.asarray(self.reached_locked.mean(axis=2) / self.directions)

    @property
    def harmless_locks(self) -> FloatArray:
        """Fraction (V, n) of the lock values of each joint with which the arm still reaches the cell."""
        return np.asarray((self.reached_locked > 0).mean(axis=2))

    @property
    def is_planar(self) -> bool:
        """True if the cells are squares in the plane of the arm, not cubes."""
        return plane_normal(self.arm) is not None

    @property
    def size(self) -> float:
        """Area (m^2) of a planar arm or volume (m^3) of all cells that the intact arm reaches."""
        return float(len(self.centers) * self.cell_size ** (2 if self.is_planar else 3))

    def to_npz(self, path: str | Path) -> Path:
        """Write the map as a numpy archive, which ``numpy.load(path)`` reads.

        Keys: ``centers_m`` (V, 3), ``cell_size_m``, ``directions``, ``reached`` (V,), ``reached_locked`` (V, n, B),
        ``lock_values`` (n, B) in rad and m, ``joint_names`` (n,), ``prismatic`` (n,), ``arm``, ``samples``, ``growth`` (n,).
        They contain the attributes of this class; the text arrays need no ``allow_pickle``.

        Raises:
            StoreError: The file cannot be written; an existing file is unchanged.
        """
        content = BytesIO()
        np.savez_compressed(
            content,
            centers_m=self.centers,
            cell_size_m=self.cell_size,
            directions=self.directions,
            reached=self.reached,
            reached_locked=self.reached_locked,
            lock_values=self.lock_values,
            joint_names=np.array(self.arm.joint_names),
            prismatic=self.arm.prismatic,
            arm=np.array(self.arm.name),
            samples=self.samples,
            growth=self.growth,
        )
        replace_file(Path(path), content.getvalue(), "the reachability map to")
        return Path(path)


@check_arguments
@reports_progress("mapping the reachable workspace")
def reachability_map(
    arm: Arm,
    *,
    at: ArrayLike | None = None,
    cell_size: float | None = None,
    bands: int = DEFAULT_BANDS,
    lock_values: int = DEFAULT_LOCK_VALUES,
    samples: int = DEFAULT_SAMPLES,
    seed: int = 0,
) -> ReachabilityMap:
    """Map in how many tool directions the arm reaches each cell of its workspace, intact and with each joint locked.

    The grid of cubic cells (squares for an arm that moves in a plane) covers every point that the arm can reach, with the first
    joint in the middle of a cell. The unit sphere of the tool's z axis is divided into ``2 bands^2`` parts of equal area:
    ``bands`` intervals of its z component, each with ``2 bands`` intervals of its azimuth. In a plane, the direction is the
    angle of the tool, and the circle is divided into as many arcs. Rotation about the z axis is free. Configurations are
    uniformly random within the joint limits, one turn for a joint without limits. Self-collision is not checked.

    Each joint is locked at ``lock_values`` values, the midpoints of equal intervals of its range, because the value at a
    failure is unknown beforehand. With ``at``, each joint is locked at its value in this configuration. Every configuration
    with a locked joint is also one of the intact arm, so a lock never adds a direction.

    Args:
        arm: Arm model.
        at: (n,) configuration with the one lock value of each joint, rad and m, within the limits. Default: several values.
        cell_size: Edge length of a cell, m. Default: 1/12 (in a plane 1/40) of the longest possible distance from the
            first joint to the tool.
        bands: Number of bands of the sphere, 1 or more.
        lock_values: Number of lock values of each joint, 1 or more.
        samples: Number of configurations for the intact arm, and for each lock value of each joint.
        seed: Seed of the samples.

    Raises:
        InputError: An option is out of range, or the grid would have too many cells.

    Source: the reachability index of Zacharias et al. 2007 is the fraction of the directions of a cell that are reached. They
    solve inverse kinematics for points on a sphere, whereas this function counts the parts of the sphere that samples of
    forward kinematics hit.
    """
    if bands < 1 or lock_values < 1 or samples < 2:
        raise InputError(
            f"bands is {bands}, lock_values {lock_values} and samples {samples}; give 1 or more bands "
            "and lock_values, and 2 or more samples"
        )
    lower, upper = sampling_limits(arm)
    if at is None:
        values = lower[:, None] + (upper - lower)[:, None] * (np.arange(lock_values) + 0.5) / lock_values
    else:
        values = arm.check_configurations(at).reshape(-1, 1)
        if len(values) != arm.n or not ((values[:, 0] >= arm.lower) & (values[:, 0] <= arm.upper)).all():
            raise InputError(f"at is {values[:, 0]}; it must be one configuration within the limits of '{arm.name}'")
    if cell_size is None:
        cell_size = max(arm.end_to_end, 1e-3) / _CELLS_PER_REACH[3 if plane_normal(arm) is None else 2]
    grid = _PoseGrid(arm, cell_size, bands)
    if grid.cell_count * grid.directions * values.shape[1] > _MAX_FLAGS:
        raise InputError(f"a grid with cell_size {cell_size:g} m has {grid.cell_count:,} cells; give a larger cell_size")
    generator = np.random.default_rng(seed)
    intact, _ = _find_poses(arm, grid, samples, generator, 0, np.array([np.nan]))
    growth, counts = np.zeros(arm.n), []
    for joint in track("joints locked", range(arm.n)):
        flags, growth[joint] = _find_poses(arm, grid, samples, generator, joint, values[joint])
        intact[..., 0] |= flags.any(axis=2)
        counts.append(flags.sum(axis=1, dtype=np.int32))
    reached = intact.sum(axis=(1, 2), dtype=np.int32)
    cells = np.flatnonzero(reached)
    return ReachabilityMap(
        arm=arm,
        centers=grid.locate_centers(cells),
        cell_size=cell_size,
        directions=grid.directions,
        reached=reached[cells],
        lock_values=values,
        reached_locked=np.stack([count[cells] for count in counts], axis=1),
        samples=samples,
        growth=growth,
    )


class _PoseGrid:
    """Cells of the tool's positions and directions.

    Attributes:
        directions: Number of directions of each cell.
        cell_count: Number of cells.
    """

    def __init__(self, arm: Arm, cell_size: float, bands: int) -> None:
        if not (np.isfinite(cell_size) and cell_size > 0):
            raise InputError(f"cell_size is {cell_size:g}; it must be a number of metres above 0")
        is_planar = plane_normal(arm) is not None
        axes = as_task(arm, "planar").rows[:, :3] if is_planar else np.eye(3)
        at_zero = arm.forward_kinematics(np.zeros(arm.n))
        # The angle of a tool in a plane is counted from its pose at zero.
        tool_axis = at_zero[:3, :3].T @ axes[0] if is_planar else np.eye(3)[2]
        reach = int(np.ceil(arm.end_to_end / cell_size))
        self._axes, self._size, self._bands, self.directions = axes, cell_size, bands, 2 * bands**2
        self._shape = (2 * reach + 1,) * len(axes)
        self.cell_count = int(np.prod([float(count) for count in self._shape]))
        self._low = axes @ (arm.base @ arm.joints[0].origin)[:3, 3] - (reach + 0.5) * cell_size
        self._plane_offset = at_zero[:3, 3] - axes.T @ (axes @ at_zero[:3, 3])
        # Columns: coordinates of the tool point, then components of the tool's direction, from the first three rows of a pose.
        position, direction = (np.einsum("ai,j->ija", axes, column) for column in (np.eye(4)[3], np.r_[tool_axis, 0]))
        self._pose_coordinates = np.concatenate([position, direction], axis=2).reshape(12, -1)

    def locate(self, poses: FloatArray) -> IndexArray:
        """Return the number (N,) of the cell and direction of poses (N, 4, 4)."""
        dimensions = len(self._axes)
        coordinates = poses.reshape(-1, 16)[:, :12] @ self._pose_coordinates
        cells = ((coordinates[:, :dimensions] - self._low) / self._size).astype(np.int64)
        x, y, *z = coordinates[:, dimensions:].T
        is_vertical = np.hypot(x, y) < _LEAST_HORIZONTAL
        azimuth = np.where(is_vertical, 0.0, np.arctan2(y, x) / (2 * np.pi)) % 1.0
        bands = [np.minimum(((component + 1) / 2 * self._bands).astype(np.int64), self._bands - 1) for component in z]
        sector_count = self.directions if not bands else 2 * self._bands
        sectors = np.minimum((azimuth * sector_count).astype(np.int64), sector_count - 1)
        return np.ravel_multi_index((*cells.T, *bands, sectors), (*self._shape, *[self._bands] * len(bands), sector_count))

    def locate_centers(self, cells: IndexArray) -> FloatArray:
        """Return the centres (V, 3) of cells, m, world."""
        coordinates = np.stack(np.unravel_index(cells, self._shape), axis=1)
        return (self._low + (coordinates + 0.5) * self._size) @ self._axes + self._plane_offset


def _find_poses(
    arm: Arm, grid: _PoseGrid, samples: int, generator: np.random.Generator, joint: int, values: FloatArray
) -> tuple[BoolArray, float]:
    """Sample configurations, the same number with one joint locked at each of its values (B,); NaN does not lock the joint.

    Returns:
        Flags of the reached cells, directions and lock values, (cells, directions, B), and the fraction of them that only the
        second half of the samples found.
    """
    lower, upper = sampling_limits(arm)
    found = np.zeros((grid.cell_count * grid.directions, len(values)), dtype=bool)
    half_count = 0
    for half in range(2):
        for index, value in enumerate(values):
            count = (samples + half) // 2
            for start in range(0, count, _BATCH_ROWS):
                q = lower + (upper - lower) * generator.random((min(_BATCH_ROWS, count - start), arm.n))
                if not np.isnan(value):
                    q[:, joint] = value
                found[grid.locate(arm.forward_kinematics(q)), index] = True
        if half == 0:
            half_count = int(found.sum())
    return found.reshape(grid.cell_count, grid.directions, -1), 1 - half_count / int(found.sum())
