"""The failed closed loop near a stationary point: its linearisation, eigenvalues, and what they make of the point.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (22). That signs change only where the determinant vanishes is not so:
complex pairs cross too, and eigenvalues are looked at everywhere.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from functools import lru_cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.caching import cached_property
from holdfast.control.law import Law
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.recall import recalled
from holdfast.simulation.system import System

Array = NDArray[np.float64]
Kinds = NDArray[np.uint8]

REACHED = 1e-6  # rad, and lengths in units of the arm's own: an error below it counts as 0
ZERO_BAND = 1e-6  # of the linearisation's norm, or of 1: real parts below it have no sign


class Kind(IntEnum):
    """What a stationary point is.

    ``SOLUTION``: the target is reached. The others are erroneous: ``SINK`` (attracts), ``SADDLE``, ``SOURCE`` (repels), and
    ``DEGENERATE`` where a real part is zero, so that the linearisation does not decide.
    """

    SOLUTION = 0
    SINK = 1
    SADDLE = 2
    SOURCE = 3
    DEGENERATE = 4

    @property
    def word(self) -> str:
        """For people."""
        return self.name.lower()


def attracts(eigenvalues: NDArray[np.complex128]) -> NDArray[np.bool_]:
    """(N,) True where no real part is above 0, zeros allowed; NaN does not attract."""
    band = ZERO_BAND * np.maximum(1.0, np.abs(eigenvalues).max(axis=1, initial=0.0))[:, None]
    return np.asarray((eigenvalues.real < band).all(axis=1))


def kinds(eigenvalues: NDArray[np.complex128], scaled: Array) -> Kinds:
    """(N,) :class:`Kind` from eigenvalues (N, h), complex, and scaled errors (N,); NaN is degenerate."""
    real = np.real(eigenvalues)
    band = ZERO_BAND * np.maximum(1.0, np.abs(eigenvalues).max(axis=1, initial=0.0))[:, None]
    conditions = [scaled < REACHED, (real < -band).all(axis=1), (real > band).all(axis=1), (np.abs(real) > band).all(axis=1)]
    chosen = np.select(conditions, [Kind.SOLUTION, Kind.SINK, Kind.SOURCE, Kind.SADDLE], Kind.DEGENERATE)
    return chosen.astype(np.uint8)


class Linearisation:
    """Rates and linearisation of the failed arm under one law, without its speed limit, in units of ``1/Ke``."""

    def __init__(self, law: Law) -> None:
        self.law, self._system = law, System(law)

    @cached_property
    @recalled
    def _rates(self) -> Kernel:
        s = self._system
        e, _ = s.error(s.q)
        sizes = ca.norm_2(e), ca.norm_2(s.scaled_error(s.q)[0])
        return Kernel("rest rates", [s.q, s.target, s.rotation], [ca.vertcat(self.law.rates(s.q, e), *sizes)])

    @cached_property
    @recalled
    def _slopes(self) -> Kernel:
        s = self._system
        e, j = s.error(s.q)
        inputs = [s.q, s.target, s.rotation]
        outputs = [self.law.with_slopes(s.q, e, s.q)[1], j, ca.norm_2(s.scaled_error(s.q)[0])]
        return Kernel("linearisation", inputs, outputs)

    def rates(self, q: Array, pose: Array) -> tuple[Array, Array, Array]:
        """Commanded rates (N, n) of all joints at q (N, n), errors (N,), m and rad, and (N,) with lengths scaled."""
        out = self._rates.rows(q, pose[:3, 3], pose[:3, :3])
        return out[:, :-2], out[:, -2], out[:, -1]

    def field(self, pose: Array, healthy: NDArray[np.bool_]) -> Callable[[Array], Array]:
        """The motion itself, rates (n,) of q (n,) with other joints still, as quick as it can be; not for several threads."""
        n, call = self.law.arm.n, self._rates.single()
        row = np.concatenate([np.zeros(n), pose[:3, 3], pose[:3, :3].ravel()])
        mask = healthy.astype(np.float64)

        def rates(q: Array) -> Array:
            row[:n] = q
            return np.asarray(call(row)[:n] * mask)

        return rates

    def matrices(self, q: Array, pose: Array, healthy: NDArray[np.bool_]) -> Array:
        """Linearisation (N, h, h) of the healthy joints at q (N, n)."""
        slopes, j, scaled = self._slopes(q, pose[:3, 3], pose[:3, :3])
        # Where the target is reached the rates change by those for -J, as the law is linear there or has no derivative; that
        # of the rotation vector is 0/0 there.
        n, there = self.law.arm.n, np.flatnonzero(scaled < REACHED)
        changes = -j[there].transpose(0, 2, 1).reshape(-1, self.law.task.m)  # of the error with each joint in turn
        rates = self.law.velocity(np.repeat(q[there], n, axis=0), changes)
        slopes[there] = rates.reshape(-1, n, n).transpose(0, 2, 1)
        return np.asarray(slopes[:, healthy][:, :, healthy])

    def eigenvalues(self, q: Array, pose: Array, healthy: NDArray[np.bool_]) -> NDArray[np.complex128]:
        """Eigenvalues (N, h) by falling real part; NaN where the law has no answer."""
        matrices = self.matrices(q, pose, healthy)
        good = np.isfinite(matrices).all(axis=(1, 2))
        out = np.full(matrices.shape[:2], np.nan, dtype=np.complex128)
        if good.any():
            values = np.linalg.eigvals(matrices[good])
            out[good] = np.take_along_axis(values, np.argsort(-values.real, axis=1, kind="stable"), axis=1)
        return out


@lru_cache(maxsize=16)
def linearisation(law: Law) -> Linearisation:
    """The compiled linearisation of a law."""
    return Linearisation(law)
