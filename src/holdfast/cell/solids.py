"""Objects of a cell that a formula describes: boxes, cylinders, capsules, spheres and half spaces."""

from __future__ import annotations

from copy import copy
from dataclasses import KW_ONLY, dataclass, field
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked_class, real_numbers
from holdfast.arm.machine import transform
from holdfast.errors import InputError

Array = NDArray[np.float64]

_UNBOUNDED = 1e9  # m: half a size that no arm reaches


@checked_class
@dataclass(frozen=True, eq=False)
class Solid:
    """An object in the world, which does not move.

    Attributes:
        name: Unique in its cell.
        pose: (4, 4) of its own frame in the world, m; where it is not turned, its position (3,) will do.
        margin: What an arm keeps from it at least, m; the cell's own margin counts where that is larger.
    """

    name: str
    _: KW_ONLY
    pose: Array = field(default_factory=lambda: np.eye(4))
    margin: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "pose", _placed(self.pose, self.name))
        if not (np.isfinite(self.margin) and self.margin >= 0):
            raise InputError(f"the margin of object '{self.name}' is {self.margin:g} m; it must be finite and 0 or more")

    def moved_to(self, pose: ArrayLike) -> Self:
        """The same object elsewhere, what was made of its shape kept; ``pose`` (4, 4) in the world, m, or a position (3,)."""
        other = copy(self)
        object.__setattr__(other, "pose", _placed(pose, self.name))
        return other

    def signed_distance(self, points: ArrayLike) -> Array:
        """Distance in m of points (..., 3) in the world from its surface, below 0 inside; never above the true one."""
        raise NotImplementedError

    def _length(self, value: float, what: str) -> None:
        if not (np.isfinite(value) and value > 0):
            raise InputError(f"the {what} of object '{self.name}' is {value:g} m; it must be finite and above 0")


@checked_class
@dataclass(frozen=True, eq=False)
class Primitive(Solid):
    """An object whose signed distance is a formula: a box with rounded edges, or what becomes of one in the limit.

    With ``y`` a point in the object's own frame, half sizes ``b`` and ``d = |y| - b``, the signed distance is
    ``||max(d, 0)|| + min(max_k d_k, 0) - rounding``. A cylinder has ``hypot(y1, y2)`` in place of ``|y1|``, a half space ``y3``
    in place of ``|y3|``; what they do not bound has a half size that no arm reaches.
    """

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """Half sizes (3,) m, rounding m, whether it is round about z, and whether it is open below its z."""
        raise NotImplementedError

    def numbers(self, extra: float = 0.0) -> Array:
        """(18,) what the compiled bound takes: rotation (9) and shift (3) into the own frame, half sizes, rounding, two flags.

        Args:
            extra: Added to the rounding, m: the distance is less by it.
        """
        half, rounding, round_, open_ = self.formula()
        into = self.pose[:3, :3].T
        return np.array([*into.ravel(), *(-into @ self.pose[:3, 3]), *half, rounding + extra, round_, open_], dtype=np.float64)

    def signed_distance(self, points: ArrayLike) -> Array:
        """Distance in m of points (..., 3) in the world from its surface, below 0 inside."""
        half, rounding, round_, open_ = self.formula()
        y = (np.asarray(points, dtype=np.float64) - self.pose[:3, 3]) @ self.pose[:3, :3]
        size = np.abs(y)
        if round_:
            size[..., 0] = np.hypot(y[..., 0], y[..., 1])
        if open_:
            size[..., 2] = y[..., 2]
        d = size - half
        inside = np.minimum(d.max(axis=-1), 0.0)
        return np.asarray(np.linalg.norm(np.maximum(d, 0.0), axis=-1) + inside - rounding)


@checked_class
@dataclass(frozen=True, eq=False)
class Box(Primitive):
    """A box; ``size`` (3,) are its full edges along its own x, y and z, m, as in URDF."""

    size: Array

    def __post_init__(self) -> None:
        super().__post_init__()
        size = np.asarray(self.size, dtype=np.float64)
        if size.shape != (3,) or not (np.isfinite(size).all() and (size > 0).all()):
            raise InputError(f"the size of object '{self.name}' is {size.tolist()}; it must be 3 finite numbers above 0, m")
        object.__setattr__(self, "size", size)

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """As every primitive has it."""
        x, y, z = (float(s) / 2 for s in self.size)
        return (x, y, z), 0.0, False, False


@dataclass(frozen=True, eq=False)
class _Rod(Primitive):
    """What is round along its own z; ``radius`` and ``length`` in m."""

    radius: float
    length: float

    def __post_init__(self) -> None:
        super().__post_init__()
        self._length(self.radius, "radius")
        self._length(self.length, "length")


@checked_class
@dataclass(frozen=True, eq=False)
class Cylinder(_Rod):
    """A cylinder along its own z with flat ends; ``radius`` and ``length`` in m, as in URDF."""

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """As every primitive has it."""
        return (self.radius, _UNBOUNDED, self.length / 2), 0.0, True, False


@checked_class
@dataclass(frozen=True, eq=False)
class Capsule(_Rod):
    """A cylinder along its own z with round ends; ``length`` is between the centres of the ends, m."""

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """As every primitive has it."""
        return (0.0, 0.0, self.length / 2), self.radius, False, False


@checked_class
@dataclass(frozen=True, eq=False)
class Sphere(Primitive):
    """A sphere; ``radius`` in m."""

    radius: float

    def __post_init__(self) -> None:
        super().__post_init__()
        self._length(self.radius, "radius")

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """As every primitive has it."""
        return (0.0, 0.0, 0.0), self.radius, False, False


@checked_class
@dataclass(frozen=True, eq=False)
class HalfSpace(Primitive):
    """Everything below the plane through its own origin, as a floor: its own z points out of it."""

    def formula(self) -> tuple[tuple[float, float, float], float, bool, bool]:
        """As every primitive has it."""
        return (_UNBOUNDED, _UNBOUNDED, 0.0), 0.0, False, True


def _placed(pose: ArrayLike, name: str) -> Array:
    a = real_numbers(pose, f"pose of object '{name}'", "a pose (4, 4) or a position (3,)")
    if a.shape == (3,):
        a = np.block([[np.eye(3), a[:, None]], [np.zeros(3), 1.0]])
    return transform(a, f"pose of object '{name}'")
