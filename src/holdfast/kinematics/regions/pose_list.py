"""List of poses, for example a recorded job or waypoints, each with an optional weight; files are CSV tables."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.files.csv_table import read_csv_table
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.kinematics.regions.weights import check_weights

POSE_COLUMNS = ("x", "y", "z", "qx", "qy", "qz", "qw")


@dataclass(frozen=True, eq=False)
class PoseList:
    """Poses with their weights.

    Attributes:
        rows: (N, 7) position, m, and quaternion x y z w, in the world.
        weights: (N,) weights of 0 or more, or None for equal weights.
    """

    rows: FloatArray
    weights: FloatArray | None = None

    def __post_init__(self) -> None:
        rows = np.array(self.rows, dtype=np.float64)
        if rows.ndim != 2 or rows.shape[1] != len(POSE_COLUMNS) or not len(rows):
            raise InputError(f"poses must be rows of {', '.join(POSE_COLUMNS)}, at least one")
        not_finite = np.flatnonzero(~np.isfinite(rows).all(axis=1))
        if not_finite.size:
            raise InputError(f"pose {not_finite[0] + 1} holds NaN or infinity; leave it out or give finite numbers")
        with np.errstate(over="ignore"):
            lengths = np.linalg.norm(rows[:, 3:], axis=1)
        not_unit = np.flatnonzero(np.abs(lengths - 1) > 1e-2)
        if not_unit.size:
            raise InputError(f"the quaternion of pose {not_unit[0] + 1} has length {lengths[not_unit[0]]:.4g}; it must be 1")
        rows.setflags(write=False)
        object.__setattr__(self, "rows", rows)
        if self.weights is not None:
            weights = check_weights(self.weights, len(rows), "poses").copy()
            if not weights.any():
                raise InputError("poses: all weights are 0; give at least one pose a weight above 0")
            weights.setflags(write=False)
            object.__setattr__(self, "weights", weights)

    @classmethod
    def from_matrices(cls, poses: ArrayLike, weights: ArrayLike | None = None) -> PoseList:
        """Return the list of poses (N, 4, 4) in the world, m, with optional weights (N,).

        Raises:
            InputError: Poses are not transforms, not finite, or none, or the weights are not one finite number >= 0 per pose.
        """
        from scipy.spatial.transform import Rotation

        from holdfast.model.arm.poses import check_poses

        try:
            checked = check_poses(poses)
        except InputError:
            raise
        except (TypeError, ValueError) as error:
            raise InputError("poses must be an (N, 4, 4) array of numbers") from error
        if not len(checked):
            raise InputError("there are no poses in the list; give at least one")
        not_finite = np.flatnonzero(~np.isfinite(checked).all(axis=(1, 2)))
        if not_finite.size:
            raise InputError(f"pose {not_finite[0] + 1} holds NaN or infinity; leave it out or give finite numbers")
        rows = np.concatenate([checked[:, :3, 3], Rotation.from_matrix(checked[:, :3, :3]).as_quat()], axis=1)
        return cls(rows, None if weights is None else np.asarray(weights))

    def __len__(self) -> int:
        return len(self.rows)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PoseList):
            return NotImplemented
        if self.weights is None or other.weights is None:
            return self.weights is other.weights and np.array_equal(self.rows, other.rows)
        return np.array_equal(self.rows, other.rows) and np.array_equal(self.weights, other.weights)

    def __hash__(self) -> int:
        return hash(self.rows.tobytes())

    def sample_indices(self, uniform: FloatArray) -> IndexArray:
        """Return the indices from 0 of the poses for uniform numbers (B,) in [0, 1), each pose in proportion to its weight."""
        cumulative = np.cumsum(np.ones(len(self)) if self.weights is None else self.weights)
        return np.asarray(np.searchsorted(cumulative / cumulative[-1], uniform, side="right"))

    def pose_matrices(self, indices: IndexArray) -> FloatArray:
        """Return the poses (B, 4, 4) with the given indices (B,)."""
        from scipy.spatial.transform import Rotation

        matrices = np.zeros((len(indices), 4, 4))
        matrices[:, :3, 3] = self.rows[indices, :3]
        matrices[:, :3, :3] = Rotation.from_quat(self.rows[indices, 3:]).as_matrix()
        matrices[:, 3, 3] = 1.0
        return matrices

    # ---- files -----------------------------------------------------------------------------------------------------

    def to_dict(self) -> dict[str, Any]:
        """Return the complete JSON data that :meth:`from_dict` reads."""
        data: dict[str, Any] = {"poses": self.rows.tolist()}
        return data if self.weights is None else data | {"weights": self.weights.tolist()}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> PoseList:
        """Return the list of :meth:`to_dict`."""
        weights = data.get("weights")
        try:
            rows = np.array(data["poses"], dtype=np.float64)
        except ValueError as error:
            raise InputError(f"poses must be rows of {', '.join(POSE_COLUMNS)}") from error
        return cls(rows, None if weights is None else np.asarray(weights))

    @classmethod
    def read_csv(cls, path: Path) -> PoseList:
        """Read a CSV table with the header x, y, z, qx, qy, qz, qw and an optional weight, in any order; m, quaternion x y z w.

        Raises:
            InputError: The file cannot be read, or a column or number is missing, unknown or wrong; the message names it.
        """
        table = read_csv_table(path, f"poses '{path}'")
        columns = f"{', '.join(POSE_COLUMNS)} and perhaps weight"
        for name in table.header:
            if name not in (*POSE_COLUMNS, "weight") or table.header.count(name) > 1:
                problem = "is given twice" if table.header.count(name) > 1 else "is not known"
                raise InputError(f"{table.title}: column '{name}' {problem}; the first line must name {columns}")
        missing = [name for name in POSE_COLUMNS if name not in table.header]
        if missing:
            raise InputError(f"{table.title}: column '{missing[0]}' is missing; the first line must name {columns}")
        numbers = table.select_columns([*POSE_COLUMNS, "weight"] if "weight" in table.header else POSE_COLUMNS)
        try:
            return cls(numbers[:, :7], numbers[:, 7] if "weight" in table.header else None)
        except InputError as error:
            raise InputError(f"{table.title}: {error}") from error

    def to_csv(self) -> str:
        """Return the CSV text that :meth:`read_csv` reads, with all digits."""
        weights = [] if self.weights is None else [self.weights[:, None]]
        rows = np.concatenate([self.rows, *weights], axis=1).tolist()
        header = ",".join([*POSE_COLUMNS, *(["weight"] if weights else [])])
        return "\n".join([header, *(",".join(repr(number) for number in row) for row in rows)]) + "\n"
