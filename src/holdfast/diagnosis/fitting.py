"""Masses and friction of one robot, fitted to its records: residuals are linear in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm.kinematics import joint_symbols
from holdfast.arm.machine import Link
from holdfast.arm.model import Arm
from holdfast.diagnosis.gaps import Stretch, seen, stretches
from holdfast.diagnosis.observer import GAIN, momentum_terms, residuals
from holdfast.faults.log import Log
from holdfast.kernels.kernel import Kernel

Array = NDArray[np.float64]

_MASS = 0.1  # prior deviation of the scale of a link's mass
_FRICTION, _KEPT = 1.0, 1e-4  # N m (N), N m s/rad (N s/m): prior deviations, and that of what is kept
_STEP = 0.5  # of a scale: residuals are linear in it, so that any step does


def scaled(arm: Arm, scales: Array) -> Arm:
    """The arm with its links' masses and inertias times (n,) scales; itself where all are 1."""
    if np.all(scales == 1):
        return arm
    links = [
        None if link is None else Link(link.mass * s, link.com, link.inertia * s, name=link.name)
        for link, s in zip(arm.links, scales.tolist(), strict=True)
    ]
    return replace(arm, links=tuple(links))


def fitted(arm: Arm, logs: Sequence[Log], coulomb: Array, viscous: Array) -> tuple[Array, Array, Array]:
    """Scales of the links' masses, dry and viscous friction, (n,) each, that explain the residuals of records best.

    Ridge: masses are believed to 10 %, friction to 1 N m and 1 N m s/rad, and dry friction that is given is kept; residuals
    count once for each time constant of the observer. What gravity and motion do not show stays as it was.

    Source: derived here.
    """
    n, symbols = arm.n, (joint_symbols(arm), ca.SX.sym("v", arm.n))
    arms = [arm, *(scaled(arm, np.where(np.arange(n) == k, 1 + _STEP, 1.0)) for k in range(n))]
    # On CasADi's machine: they are called a few times, and never again.
    plain, *heavier = (
        Kernel("momentum", symbols, [ca.densify(x) for x in momentum_terms(of, *symbols)], backend="casadi") for of in arms
    )
    # What is given of dry friction tells later whether friction can hold a joint: motion alone may show none of it.
    prior = np.r_[np.full(n, _MASS), np.where(coulomb > 0, _KEPT, _FRICTION), np.full(n, _FRICTION)]
    normal, right = np.diag(prior**-2.0), np.zeros(3 * n)
    deviation: Array | None = None
    for log in logs:
        if log.tau is None:
            continue
        residual = partial(_sampled, parts=[*stretches(log, seen(log))], rate=log.rate)
        r = residual(plain, coulomb, viscous)
        deviation = np.maximum(r.std(axis=0), 1e-6) if deviation is None else deviation
        columns = np.zeros((*r.shape, 3 * n))
        for k in range(n):
            columns[:, :, k] = (residual(heavier[k], coulomb, viscous) - r) / _STEP
        # Friction of a joint is on its own row alone.
        dry, wet = residual(plain, coulomb + 1, viscous) - r, residual(plain, coulomb, viscous + 1) - r
        for k in range(n):
            columns[:, k, n + k], columns[:, k, 2 * n + k] = dry[:, k], wet[:, k]
        rows = (columns / deviation[:, None]).reshape(-1, 3 * n)
        normal += rows.T @ rows
        right -= rows.T @ (r / deviation).ravel()
    theta = np.linalg.solve(normal, right)
    dry, wet = coulomb + theta[n : 2 * n], viscous + theta[2 * n :]
    return np.asarray(1 + theta[:n]), np.maximum(dry, 0.0), np.maximum(wet, 0.0)


def _sampled(kernel: Kernel, coulomb: Array, viscous: Array, *, parts: Sequence[Stretch], rate: float) -> Array:
    """Residuals of a record, one for each time constant of the observer."""
    of = partial(residuals, kernel, dt=1 / rate, coulomb=coulomb, viscous=viscous)
    found = [of(part.q, part.tau, settling=part.settling)[0] for part in parts if part.tau is not None]
    return np.concatenate([r[:: max(1, round(rate / GAIN))] for r in found])
