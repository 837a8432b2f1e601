"""The motion of the healthy arm towards a target, before a joint locks, for many starts side by side.

``q' = G(q) e(q)`` in the time of the law; here it is followed over the fraction s of the way, ``1 - s = exp(-Ke t)``:
``dq/ds = G(q) e(q) / (1 - s)``. Under an exact inverse the end effector is then at the share s of the straight line to the
target.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (5), (6).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.control.law import Law
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.simulation.system import System

Array = NDArray[np.float64]

TOLERANCE = 1e-7  # rad (and m): error of a step
_HALVED = 12  # times at most: a start that needs more has met a singular configuration


class HealthyPaths:
    """The compiled step of one law: Dormand-Prince 5(4), with the estimate of its error."""

    def __init__(self, law: Law) -> None:
        from scipy.integrate import RK45  # only its coefficients

        self.law = law
        system = System(law)
        s, h = ca.SX.sym("s"), ca.SX.sym("h")

        def slope(q: SX, at: SX) -> SX:
            e, _ = system.error(q)
            return law.rates(q, e) / (1 - at)

        rates = [slope(system.q, s)]
        for row in [*(RK45.A[i, :i].tolist() for i in range(1, 6)), RK45.B.tolist()]:
            q = system.q + h * sum(w * k for w, k in zip(row, rates, strict=True))
            rates.append(slope(q, s + h * sum(row)))
        error = h * sum(w * k for w, k in zip(RK45.E.tolist(), rates, strict=True))
        size = ca.sqrt(ca.sumsqr(error))
        self._step = Kernel("healthy motion", [system.q, s, h, system.target, system.rotation], [ca.vertcat(q, size)])

    def cells(self, q0: Array, poses: Array, count: int) -> Iterator[Array]:
        """Configurations (R, n) at the middle of each of ``count`` equal parts of the way from q0 (R, n) to poses (R, 4, 4).

        A row is NaN once the motion meets a singular configuration of the law.
        """
        q, at = q0, 0.0
        place, turn = np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
        for k in range(count):
            to = (k + 0.5) / count
            q = self._to(q, place, turn, at, to, _HALVED)
            at = to
            yield q

    def _to(self, q: Array, place: Array, turn: Array, at: float, to: float, halved: int) -> Array:
        rows = np.full(len(q), at), np.full(len(q), to - at)
        out = self._step.rows(q, *rows, place, turn)
        new = out[:, :-1]
        bad = np.flatnonzero(~(out[:, -1] <= TOLERANCE) & np.isfinite(q).all(axis=1))
        if not bad.size:
            return new
        if not halved:
            new[bad] = np.nan
            return new
        middle = (at + to) / 2
        half = self._to(q[bad], place[bad], turn[bad], at, middle, halved - 1)
        new[bad] = self._to(half, place[bad], turn[bad], middle, to, halved - 1)
        return new


@lru_cache(maxsize=16)
def healthy_paths(law: Law) -> HealthyPaths:
    """The compiled step of a law, made once."""
    return HealthyPaths(law)
