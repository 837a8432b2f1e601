"""Motion of the healthy arm towards a target before a joint locks, for many starts in parallel.

In the time of the law, ``q' = G(q) e(q)``. Here the motion is integrated over the fraction s of the path with
``1 - s = exp(-Ke t)``, which gives ``dq/ds = G(q) e(q) / (1 - s)``. With an exact inverse, the end effector is at the fraction
s of the straight line to the target.

Source: Goel, Maciejewski, Balakrishnan 2005, eq. (5), (6).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import casadi as ca
import numpy as np

from holdfast.control.laws.law import Law
from holdfast.control.simulation.system import FailedArmSystem
from holdfast.core.typing import FloatArray
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX

STEP_TOLERANCE = 1e-7  # rad (and m): error of a step
_MAX_HALVINGS = 12  # a start that needs more halvings of a step has met a singular configuration


class HealthyPaths:
    """Compiled Dormand-Prince 5(4) step of the healthy motion under one law, with its error estimate."""

    def __init__(self, law: Law) -> None:
        from scipy.integrate import RK45  # only its coefficients

        self.law = law
        system = FailedArmSystem(law)
        progress, step = ca.SX.sym("s"), ca.SX.sym("h")

        def path_rates(q: SX, fraction: SX) -> SX:
            error_vector, _ = system.error_and_jacobian(q)
            return law.rates(q, error_vector) / (1 - fraction)

        rates = [path_rates(system.q, progress)]
        for weights in [*(RK45.A[i, :i].tolist() for i in range(1, 6)), RK45.B.tolist()]:
            q = system.q + step * sum(w * k for w, k in zip(weights, rates, strict=True))
            rates.append(path_rates(q, progress + step * sum(weights)))
        error = step * sum(w * k for w, k in zip(RK45.E.tolist(), rates, strict=True))
        error_norm = ca.sqrt(ca.sumsqr(error))
        self._step = Kernel(
            "healthy motion", [system.q, progress, step, system.target, system.rotation], [ca.vertcat(q, error_norm)]
        )

    def iterate_cell_midpoints(self, q0: FloatArray, poses: FloatArray, count: int) -> Iterator[FloatArray]:
        """Yield configurations (R, n) at the middle of each of ``count`` equal parts of the path.

        The paths lead from q0 (R, n) to poses (R, 4, 4). A row is NaN once its motion has met a singular configuration of the
        law.
        """
        q, fraction = q0, 0.0
        position, rotation = np.ascontiguousarray(poses[:, :3, 3]), np.ascontiguousarray(poses[:, :3, :3])
        for cell in range(count):
            next_fraction = (cell + 0.5) / count
            q = self._integrate_to(q, position, rotation, fraction, next_fraction, _MAX_HALVINGS)
            fraction = next_fraction
            yield q

    def _integrate_to(
        self,
        q: FloatArray,
        position: FloatArray,
        rotation: FloatArray,
        fraction: float,
        next_fraction: float,
        halvings_left: int,
    ) -> FloatArray:
        step_inputs = np.full(len(q), fraction), np.full(len(q), next_fraction - fraction)
        outputs = self._step.rows(q, *step_inputs, position, rotation)
        configurations = outputs[:, :-1]
        rejected = np.flatnonzero(~(outputs[:, -1] <= STEP_TOLERANCE) & np.isfinite(q).all(axis=1))
        if not rejected.size:
            return configurations
        if not halvings_left:
            configurations[rejected] = np.nan
            return configurations
        middle = (fraction + next_fraction) / 2
        middle_configurations = self._integrate_to(
            q[rejected], position[rejected], rotation[rejected], fraction, middle, halvings_left - 1
        )
        configurations[rejected] = self._integrate_to(
            middle_configurations, position[rejected], rotation[rejected], middle, next_fraction, halvings_left - 1
        )
        return configurations


@lru_cache(maxsize=16)
def compiled_healthy_paths(law: Law) -> HealthyPaths:
    """Return the compiled step of a law, which is cached."""
    return HealthyPaths(law)
