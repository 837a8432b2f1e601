"""The arm with two unit links, joint 1 locked at 0: the cases of Fig. 2 and their motions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

import holdfast as hf
from holdfast.control.simulation import RunPath

Array = NDArray[np.float64]

START = np.deg2rad([0.0, -30.0])
SAMPLES = 20_001


@dataclass(frozen=True)
class Case:
    """A target of Fig. 2, and the specification's numbers.

    Attributes:
        name: As in the paper.
        what: What the paper says happens.
        rho, phi: Polar coordinates of the target about joint 2, m and deg.
        rate: Of joint 2 at the start, rad/s.
        angle: Of joint 2 at the end, deg, not wrapped; None where it does not end.
        errors: At the start, at the end, least possible, greatest on the way, m; None where it says nothing.
    """

    name: str
    what: str
    rho: float
    phi: float
    rate: float
    angle: float | None
    errors: tuple[float, float | None, float, float | None]


CASES = (
    Case("A", "successful convergence", 1, 45, -1.800199, -315.0, (1.217523, 0.0, 0.0, 2.0)),
    Case("B", "no motion at all", 1, 0, 0.0, -30.0, (0.517638, 0.517638, 0.0, None)),
    Case("C", "erroneous convergence", 2, 120, -9.196152, -261.7868, (2.909313, 1.133893, 1.0, 3.0)),
    Case("D", "no convergence", 2, 60, -1.732051, None, (2.236068, None, 1.0, 3.0)),
)


@cache
def law() -> hf.control.Pseudoinverse:
    """The controller: here the inverse of the Jacobian, and Ke = 1."""
    return hf.control.pseudoinverse(hf.arms.load("planar-2r"), "planar")


def target(rho: ArrayLike, phi: ArrayLike) -> Array:
    """(..., 2) the point at polar coordinates (17) about joint 2, phi in degrees."""
    angle, distance = np.deg2rad(phi), np.asarray(rho, dtype=np.float64)
    arrays = np.broadcast_arrays(1 + distance * np.cos(angle), distance * np.sin(angle))
    return np.stack(arrays, axis=-1)


def hand(angle: ArrayLike) -> Array:
    """(..., 2) where the end effector is when joint 2 is at an angle, rad, and joint 1 at 0."""
    return np.stack([1 + np.cos(angle), np.sin(angle)], axis=-1)


def rate(angle: ArrayLike, x: Array) -> Array:
    """(15), reconstructed: rad/s of joint 2 for targets x (..., 2)."""
    return np.asarray((2 - x[..., 0]) / np.tan(np.asarray(angle) / 2) - x[..., 1])


def wrapped(degrees: ArrayLike) -> Array:
    """In (-180, 180]."""
    return np.asarray(180 - np.mod(180 - np.asarray(degrees), 360))


def runs(rho: ArrayLike, phi: ArrayLike) -> hf.Runs:
    """From the start to a target, or to many, with joint 1 locked."""
    return hf.simulate(law(), START, target(rho, phi), locked=[0])


@dataclass(frozen=True)
class Ended:
    """One of the four cases as it came out."""

    case: Case
    run: hf.Runs
    rate: float
    path: RunPath

    @property
    def angle(self) -> float:
        """Of joint 2 at the end, deg."""
        return float(np.rad2deg(self.run.q_final[1]))


def ended(case: Case) -> Ended:
    """Simulate a case."""
    run = runs(case.rho, case.phi)
    first = float(law().velocity(START, run.target - hand(START[1]))[1])
    return Ended(case, run, first, run.path(0, SAMPLES, until=40.0))
