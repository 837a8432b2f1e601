"""Check the weights of poses, and define weight densities that a file can hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray

Points = TypeVar("Points")

COORDINATE_NAMES = ("x", "y", "z", "roll", "pitch", "yaw")


def check_weights(weights: ArrayLike, count: int, label: str) -> FloatArray:
    """Return the weights (count,) as float64.

    Raises:
        InputError: The weights are not ``count`` finite numbers of 0 or more; the message begins with ``label``.
    """
    try:
        array = np.asarray(weights, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{label}: weights must be numbers, one per pose") from error
    if array.shape != (count,):
        raise InputError(f"{label}: weights have shape {array.shape}; they must have shape ({count},), one per pose")
    invalid = np.flatnonzero(~(np.isfinite(array) & (array >= 0)))
    if invalid.size:
        raise InputError(f"{label}: weight {invalid[0] + 1} is {array[invalid[0]]:g}; weights must be finite and 0 or more")
    return array


def swap_roll_and_yaw(points: Mapping[str, Points]) -> dict[str, Points]:
    """Swap roll and yaw, because samples have the order of Abdi et al. 2012, whose names are the reverse of URDF's."""
    return {{"roll": "yaw", "yaw": "roll"}.get(name, name): value for name, value in points.items()}


@dataclass(frozen=True)
class Density:
    """Weight of samples of a box: the product of one piecewise linear function per coordinate.

    Beyond its outermost points each function is constant.

    Attributes:
        pieces: Name of the coordinate (``x, y, z``, m, ``roll, pitch, yaw`` as Abdi et al. 2012, rad) and its
            (coordinate, weight) points.
    """

    pieces: tuple[tuple[str, tuple[tuple[float, float], ...]], ...]

    @classmethod
    def from_points(cls, points_by_coordinate: Mapping[str, Sequence[Sequence[float]]]) -> Density:
        """Return the density of points such as ``{"z": [(0.0, 1), (0.5, 3)]}``.

        Raises:
            InputError: A coordinate is not known, points do not ascend, or weights are negative or 0 everywhere.
        """
        pieces = []
        for name, points in points_by_coordinate.items():
            if name not in COORDINATE_NAMES:
                raise InputError(f"region: density of '{name}' is not known; use {', '.join(COORDINATE_NAMES)}")
            try:
                array = np.asarray(points, dtype=np.float64)
            except (TypeError, ValueError):
                array = np.zeros(0)
            if array.ndim != 2 or array.shape[1] != 2 or not len(array) or not np.isfinite(array).all():
                raise InputError(f"region: density of {name} must be points [coordinate, weight] of finite numbers")
            if (np.diff(array[:, 0]) <= 0).any():
                raise InputError(f"region: density of {name}: the coordinates of its points must ascend")
            if (array[:, 1] < 0).any() or not array[:, 1].any():
                raise InputError(f"region: density of {name}: weights must be 0 or more, at least one of them above 0")
            pieces.append((name, tuple((float(coordinate), float(weight)) for coordinate, weight in array)))
        if not pieces:
            raise InputError(f"region: a density needs at least one of {', '.join(COORDINATE_NAMES)}")
        return cls(tuple(pieces))

    def __call__(self, samples: FloatArray) -> FloatArray:
        """Return the weights (N,) of samples (N, 6) of a box."""
        weight = np.ones(len(samples))
        for name, points in self.pieces:
            coordinates, values = np.array(points).T
            weight *= np.interp(samples[:, COORDINATE_NAMES.index(name)], coordinates, values)
        return weight

    @property
    def heaviest(self) -> float:
        """Largest weight of any sample."""
        return float(np.prod([max(weight for _, weight in points) for _, points in self.pieces]))

    def to_dict(self) -> dict[str, list[list[float]]]:
        """Return the JSON data that :meth:`from_points` reads."""
        return {name: [list(point) for point in points] for name, points in self.pieces}

    def describe(self) -> str:
        """Describe the weights in degrees and meters."""
        parts = []
        for name, points in self.pieces:
            unit, factor = (" m", 1.0) if COORDINATE_NAMES.index(name) < 3 else (" deg", 180 / np.pi)
            parts.append(
                f"{next(iter(swap_roll_and_yaw({name: points})))} "
                + ", ".join(f"{weight:.4g} at {factor * coordinate:.4g}{unit}" for coordinate, weight in points)
            )
        return "weight by " + "; ".join(parts) + "; linear between"
