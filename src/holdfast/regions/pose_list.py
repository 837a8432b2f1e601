"""A list of poses: a recorded job, waypoints; each with a weight if it has one. In files a table of CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError
from holdfast.files import reading
from holdfast.regions.weights import check_weights

Array = NDArray[np.float64]

COLUMNS = ("x", "y", "z", "qx", "qy", "qz", "qw")


@dataclass(frozen=True, eq=False)
class PoseList:
    """Poses with their weights.

    Attributes:
        rows: (N, 7) position, m, and quaternion x y z w, in the world.
        weights: (N,) 0 or more, or None if all count alike.
    """

    rows: Array
    weights: Array | None = None

    def __post_init__(self) -> None:
        rows = np.array(self.rows, dtype=np.float64)
        if rows.ndim != 2 or rows.shape[1] != len(COLUMNS) or not len(rows):
            raise InputError(f"poses must be rows of {', '.join(COLUMNS)}, at least one")
        wrong = np.flatnonzero(~np.isfinite(rows).all(axis=1))
        if wrong.size:
            raise InputError(f"pose {wrong[0] + 1} holds NaN or infinity; leave it out or give finite numbers")
        with np.errstate(over="ignore"):
            norm = np.linalg.norm(rows[:, 3:], axis=1)
        off = np.flatnonzero(np.abs(norm - 1) > 1e-2)
        if off.size:
            raise InputError(f"the quaternion of pose {off[0] + 1} has length {norm[off[0]]:.4g}; it must be 1")
        rows.setflags(write=False)
        object.__setattr__(self, "rows", rows)
        if self.weights is not None:
            weights = check_weights(self.weights, len(rows), "poses").copy()
            if not weights.any():
                raise InputError("poses: all weights are 0; give at least one pose a weight above 0")
            weights.setflags(write=False)
            object.__setattr__(self, "weights", weights)

    @classmethod
    def of(cls, poses: ArrayLike, weights: ArrayLike | None = None) -> PoseList:
        """From (N, 4, 4) poses in the world, m.

        Raises:
            InputError: Not transforms, not finite, none at all, or weights that are not one finite number >= 0 per pose.
        """
        from scipy.spatial.transform import Rotation

        from holdfast.arm.poses import check_poses

        try:
            t = check_poses(poses)
        except InputError:
            raise
        except (TypeError, ValueError) as error:
            raise InputError("poses must be an (N, 4, 4) array of numbers") from error
        if not len(t):
            raise InputError("there are no poses in the list; give at least one")
        wrong = np.flatnonzero(~np.isfinite(t).all(axis=(1, 2)))
        if wrong.size:
            raise InputError(f"pose {wrong[0] + 1} holds NaN or infinity; leave it out or give finite numbers")
        rows = np.concatenate([t[:, :3, 3], Rotation.from_matrix(t[:, :3, :3]).as_quat()], axis=1)
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

    def pick(self, unit: Array) -> NDArray[np.int64]:
        """Numbers from 0 of the poses at uniform ``unit`` (B,) in [0, 1): each as often as its weight says."""
        total = np.cumsum(np.ones(len(self)) if self.weights is None else self.weights)
        return np.asarray(np.searchsorted(total / total[-1], unit, side="right"))

    def poses(self, numbers: NDArray[np.int64]) -> Array:
        """(B, 4, 4)"""
        from scipy.spatial.transform import Rotation

        t = np.zeros((len(numbers), 4, 4))
        t[:, :3, 3] = self.rows[numbers, :3]
        t[:, :3, :3] = Rotation.from_quat(self.rows[numbers, 3:]).as_matrix()
        t[:, 3, 3] = 1.0
        return t

    # ---- files -----------------------------------------------------------------------------------------------------

    def to_dict(self) -> dict[str, Any]:
        """JSON data that :meth:`from_dict` reads, complete."""
        found: dict[str, Any] = {"poses": self.rows.tolist()}
        return found if self.weights is None else found | {"weights": self.weights.tolist()}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> PoseList:
        """What :meth:`to_dict` wrote."""
        weights = data.get("weights")
        try:
            rows = np.array(data["poses"], dtype=np.float64)
        except ValueError as error:
            raise InputError(f"poses must be rows of {', '.join(COLUMNS)}") from error
        return cls(rows, None if weights is None else np.asarray(weights))

    @classmethod
    def read(cls, path: Path) -> PoseList:
        """A CSV table with the header x, y, z, qx, qy, qz, qw and perhaps weight, in any order; m, quaternion x y z w.

        Raises:
            InputError: Unreadable, or a column or number that is missing, unknown or wrong; the message names it.
        """
        try:
            with reading.guarded(f"poses '{path}'"):
                text = reading.text(path)
        except UnicodeDecodeError as error:
            raise InputError(f"poses '{path}' are not text in UTF-8; save the table as CSV") from error
        try:
            return cls._parse(csv.reader(io.StringIO(text)))
        except csv.Error as error:
            raise InputError(f"poses '{path}' are not a CSV table: {error}") from error
        except InputError as error:
            raise InputError(f"poses '{path}': {error}") from error

    @classmethod
    def _parse(cls, lines: Iterable[list[str]]) -> PoseList:
        table = [(k, cells) for k, cells in enumerate(lines, 1) if any(c.strip() for c in cells)]
        head = [c.strip() for c in table[0][1]] if table else []
        for name in head:
            if name not in (*COLUMNS, "weight") or head.count(name) > 1:
                what = "is given twice" if head.count(name) > 1 else "is not known"
                raise InputError(f"column '{name}' {what}; the first line must name {', '.join(COLUMNS)} and perhaps weight")
        lost = [name for name in COLUMNS if name not in head]
        if lost:
            raise InputError(f"column '{lost[0]}' is missing; the first line must name {', '.join(COLUMNS)} and perhaps weight")
        numbers = []
        for line, cells in table[1:]:
            if len(cells) != len(head):
                raise InputError(f"line {line} has {len(cells)} cells; the header has {len(head)}")
            try:
                numbers.append([float(c) for c in cells])
            except ValueError as error:
                raise InputError(f"line {line}: {error}; every cell must be a number") from error
        if not numbers:
            raise InputError("there are no poses below the header; give at least one")
        a = np.array(numbers)
        return cls(a[:, [head.index(c) for c in COLUMNS]], a[:, head.index("weight")] if "weight" in head else None)

    def table(self) -> str:
        """The CSV text that :meth:`read` reads, with every digit."""
        weights = [] if self.weights is None else [self.weights[:, None]]
        rows = np.concatenate([self.rows, *weights], axis=1).tolist()
        head = ",".join([*COLUMNS, *(["weight"] if weights else [])])
        return "\n".join([head, *(",".join(repr(x) for x in row) for row in rows)]) + "\n"
