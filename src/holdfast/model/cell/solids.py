"""Objects of a cell with a distance formula: boxes, cylinders, capsules, spheres, and half spaces."""

from __future__ import annotations

from copy import copy
from dataclasses import KW_ONLY, dataclass, field
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_constructor, require_real_numbers
from holdfast.model.arm.machine import check_transform

_UNBOUNDED_HALF_SIZE_M = 1e9  # m: half a size beyond the reach of any arm


@check_constructor
@dataclass(frozen=True, eq=False)
class Solid:
    """Static object in the world.

    Attributes:
        name: Name, unique in its cell.
        pose: (4, 4) pose of its own frame in the world, m; a position (3,) if it is not rotated.
        margin: Smallest distance that an arm must keep, m; the larger of this and the cell's margin counts.
    """

    name: str
    _: KW_ONLY
    pose: FloatArray = field(default_factory=lambda: np.eye(4))
    margin: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "pose", _resolve_pose(self.pose, self.name))
        if not (np.isfinite(self.margin) and self.margin >= 0):
            raise InputError(f"the margin of object '{self.name}' is {self.margin:g} m; it must be finite and 0 or more")

    def moved_to(self, pose: ArrayLike) -> Self:
        """Return the same object at another ``pose`` (4, 4) in the world, or position (3,), m; data of its shape are kept."""
        moved = copy(self)
        object.__setattr__(moved, "pose", _resolve_pose(pose, self.name))
        return moved

    def signed_distance(self, points: ArrayLike) -> FloatArray:
        """Return the distance of ``points`` (..., 3) in the world from the surface, m, below 0 inside, never too large."""
        raise NotImplementedError

    def _require_length(self, value: float, quantity: str) -> None:
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"the {quantity} of object '{self.name}' is {value:g} m; it must be finite and above 0")


@check_constructor
@dataclass(frozen=True, eq=False)
class PrimitiveSolid(Solid):
    """Object with a formula for its signed distance: a box with rounded edges, or one of its limiting cases.

    With ``y`` a point in the object's own frame, half sizes ``b`` and ``d = |y| - b``, the signed distance is ``||max(d, 0)|| +
    min(max_k d_k, 0) - rounding``. A cylinder has ``hypot(y1, y2)`` instead of ``|y1|``, and a half space ``y3`` instead of
    ``|y3|``; in unbounded directions the half size is beyond the reach of any arm.
    """

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """Return half sizes (3,), m, the rounding, m, whether it is round about z, and whether it is open below its z."""
        raise NotImplementedError

    def numbers(self, extra: float = 0.0) -> FloatArray:
        """Return the inputs (18,) of the compiled bound: rotation (9) and translation (3), half sizes, rounding, flags.

        Args:
            extra: Length added to the rounding, m, which reduces the distance.
        """
        half_sizes, rounding, round_, open_ = self.formula()
        to_object = self.pose[:3, :3].T
        return np.array(
            [*to_object.ravel(), *(-to_object @ self.pose[:3, 3]), *half_sizes, rounding + extra, round_, open_],
            dtype=np.float64,
        )

    def signed_distance(self, points: ArrayLike) -> FloatArray:
        """Return the distance of points (..., 3) in the world from the surface, m, below 0 inside."""
        half_sizes, rounding, round_, open_ = self.formula()
        local_points = (np.asarray(points, dtype=np.float64) - self.pose[:3, 3]) @ self.pose[:3, :3]
        absolute = np.abs(local_points)
        if round_:
            absolute[..., 0] = np.hypot(local_points[..., 0], local_points[..., 1])
        if open_:
            absolute[..., 2] = local_points[..., 2]
        excess = absolute - half_sizes
        inside = np.minimum(excess.max(axis=-1), 0.0)
        return np.asarray(np.linalg.norm(np.maximum(excess, 0.0), axis=-1) + inside - rounding)


@check_constructor
@dataclass(frozen=True, eq=False)
class Box(PrimitiveSolid):
    """Box with the full edges ``size`` (3,) along its own x, y, and z, m, as in URDF."""

    size: FloatArray

    def __post_init__(self) -> None:
        super().__post_init__()
        size = np.asarray(self.size, dtype=np.float64)
        if size.shape != (3,) or not (np.isfinite(size).all() and (size > 0).all()):
            raise InputError(f"the size of object '{self.name}' is {size.tolist()}; it must be 3 finite numbers above 0, m")
        object.__setattr__(self, "size", size)

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """Return the terms of the distance formula; see :meth:`holdfast.model.cell.solids.PrimitiveSolid.formula`."""
        x, y, z = (float(edge) / 2 for edge in self.size)
        return (x, y, z), 0.0, False, False


@dataclass(frozen=True, eq=False)
class _RoundSolid(PrimitiveSolid):
    """Object that is round about its own z axis; ``radius`` and ``length`` in m."""

    radius: float
    length: float

    def __post_init__(self) -> None:
        super().__post_init__()
        self._require_length(self.radius, "radius")
        self._require_length(self.length, "length")


@check_constructor
@dataclass(frozen=True, eq=False)
class Cylinder(_RoundSolid):
    """Cylinder along its own z axis with flat ends; ``radius`` and ``length`` in m, as in URDF."""

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """Return the terms of the distance formula; see :meth:`holdfast.model.cell.solids.PrimitiveSolid.formula`."""
        return (self.radius, _UNBOUNDED_HALF_SIZE_M, self.length / 2), 0.0, True, False


@check_constructor
@dataclass(frozen=True, eq=False)
class Capsule(_RoundSolid):
    """Cylinder along its own z axis with round ends; ``length`` is the distance between the centers of the ends, m."""

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """Return the terms of the distance formula; see :meth:`holdfast.model.cell.solids.PrimitiveSolid.formula`."""
        return (0.0, 0.0, self.length / 2), self.radius, False, False


@check_constructor
@dataclass(frozen=True, eq=False)
class Sphere(PrimitiveSolid):
    """Sphere with ``radius`` in m."""

    radius: float

    def __post_init__(self) -> None:
        super().__post_init__()
        self._require_length(self.radius, "radius")

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """Return the terms of the distance formula; see :meth:`holdfast.model.cell.solids.PrimitiveSolid.formula`."""
        return (0.0, 0.0, 0.0), self.radius, False, False


@check_constructor
@dataclass(frozen=True, eq=False)
class HalfSpace(PrimitiveSolid):
    """Half space below the plane through its own origin, for example a floor: its own z axis points out of it."""

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """Return the terms of the distance formula; see :meth:`holdfast.model.cell.solids.PrimitiveSolid.formula`."""
        return (_UNBOUNDED_HALF_SIZE_M, _UNBOUNDED_HALF_SIZE_M, 0.0), 0.0, False, True


def _resolve_pose(pose: ArrayLike, name: str) -> FloatArray:
    array = require_real_numbers(pose, f"pose of object '{name}'", "a pose (4, 4) or a position (3,)")
    if array.shape == (3,):
        array = np.block([[np.eye(3), array[:, None]], [np.zeros(3), 1.0]])
    return check_transform(array, f"pose of object '{name}'")
