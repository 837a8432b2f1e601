"""How much each pose of a region counts: checked weights, and densities that a file can hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError

Array = NDArray[np.float64]

Points = TypeVar("Points")

COORDINATES = ("x", "y", "z", "roll", "pitch", "yaw")


def check_weights(weights: ArrayLike, count: int, what: str) -> Array:
    """Weights (count,) as float64.

    Raises:
        InputError: Not so many finite numbers of 0 or more; the message begins with ``what``.
    """
    try:
        w = np.asarray(weights, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{what}: weights must be numbers, one per pose") from error
    if w.shape != (count,):
        raise InputError(f"{what}: weights have shape {w.shape}; they must have shape ({count},), one per pose")
    wrong = np.flatnonzero(~(np.isfinite(w) & (w >= 0)))
    if wrong.size:
        raise InputError(f"{what}: weight {wrong[0] + 1} is {w[wrong[0]]:g}; weights must be finite and 0 or more")
    return w


def swap_angles(points: Mapping[str, Points]) -> dict[str, Points]:
    """Swap roll and yaw: those of URDF are the yaw and roll of Abdi et al. 2012, in which samples are stored."""
    return {{"roll": "yaw", "yaw": "roll"}.get(name, name): value for name, value in points.items()}


@dataclass(frozen=True)
class Density:
    """A weight of samples of a box: the product of one piecewise linear function per coordinate.

    Beyond its outermost points a function keeps its last value.

    Attributes:
        pieces: Name of the coordinate (``x, y, z``, m, ``roll, pitch, yaw`` as Abdi et al. 2012, rad) and its
            (coordinate, weight) points.
    """

    pieces: tuple[tuple[str, tuple[tuple[float, float], ...]], ...]

    @classmethod
    def of(cls, given: Mapping[str, Sequence[Sequence[float]]]) -> Density:
        """From ``{"z": [(0.0, 1), (0.5, 3)]}``.

        Raises:
            InputError: Another coordinate, points that do not ascend, or negative weights, or 0 everywhere.
        """
        pieces = []
        for name, points in given.items():
            if name not in COORDINATES:
                raise InputError(f"region: density of '{name}' is not known; use {', '.join(COORDINATES)}")
            try:
                a = np.asarray(points, dtype=np.float64)
            except (TypeError, ValueError):
                a = np.zeros(0)
            if a.ndim != 2 or a.shape[1] != 2 or not len(a) or not np.isfinite(a).all():
                raise InputError(f"region: density of {name} must be points [coordinate, weight] of finite numbers")
            if (np.diff(a[:, 0]) <= 0).any():
                raise InputError(f"region: density of {name}: the coordinates of its points must ascend")
            if (a[:, 1] < 0).any() or not a[:, 1].any():
                raise InputError(f"region: density of {name}: weights must be 0 or more, at least one of them above 0")
            pieces.append((name, tuple((float(x), float(w)) for x, w in a)))
        if not pieces:
            raise InputError(f"region: a density needs at least one of {', '.join(COORDINATES)}")
        return cls(tuple(pieces))

    def __call__(self, samples: Array) -> Array:
        """Weights (N,) of samples (N, 6) of a box."""
        weight = np.ones(len(samples))
        for name, points in self.pieces:
            at, value = np.array(points).T
            weight *= np.interp(samples[:, COORDINATES.index(name)], at, value)
        return weight

    @property
    def heaviest(self) -> float:
        """The largest weight anywhere."""
        return float(np.prod([max(w for _, w in points) for _, points in self.pieces]))

    def to_dict(self) -> dict[str, list[list[float]]]:
        """JSON data that :meth:`of` reads."""
        return {name: [list(p) for p in points] for name, points in self.pieces}

    def describe(self) -> str:
        """For people, degrees and metres."""
        parts = []
        for name, points in self.pieces:
            unit, scale = (" m", 1.0) if COORDINATES.index(name) < 3 else (" deg", 180 / np.pi)
            parts.append(
                f"{next(iter(swap_angles({name: points})))} "
                + ", ".join(f"{w:.4g} at {scale * x:.4g}{unit}" for x, w in points)
            )
        return "weight by " + "; ".join(parts) + "; linear between"
