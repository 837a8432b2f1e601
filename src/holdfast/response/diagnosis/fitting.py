"""Fit masses and friction of one robot to its logs; the residuals are linear in them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import casadi as ca
import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kernels.kernel import Kernel
from holdfast.model.arm.kinematics import joint_symbols
from holdfast.model.arm.machine import Link
from holdfast.model.arm.model import Arm
from holdfast.response.diagnosis.gaps import LogSegment, complete_row_mask, split_at_gaps
from holdfast.response.diagnosis.observer import OBSERVER_GAIN_PER_S, momentum_terms, observe_residuals
from holdfast.response.faults.log import Log

_MASS_PRIOR_DEVIATION = 0.1  # relative prior deviation of the mass of a link
_FRICTION_PRIOR_DEVIATION = 1.0  # prior deviation, N m (N) and N m s/rad (N s/m)
_FIXED_FRICTION_DEVIATION = 1e-4  # prior deviation of friction that is kept
_SCALE_STEP = 0.5  # step of a mass scale; residuals are linear in it, so that any step gives the exact slope


def scale_masses(arm: Arm, scales: FloatArray) -> Arm:
    """Return the arm with its links' masses and inertias multiplied by (n,) scales, or the same arm if all scales are 1."""
    if np.all(scales == 1):
        return arm
    links = [
        None if link is None else Link(link.mass * scale, link.com, link.inertia * scale, name=link.name)
        for link, scale in zip(arm.links, scales.tolist(), strict=True)
    ]
    return replace(arm, links=tuple(links))


def fit_masses_and_friction(
    arm: Arm, logs: Sequence[Log], coulomb: FloatArray, viscous: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Fit scales of the links' masses and dry and viscous friction, (n,) each, to the residuals of logs.

    Ridge regression: prior deviations are 10 % for masses, 1 N m and 1 N m s/rad for friction, and close to 0 for dry friction
    that is given. Residuals count once per time constant of the observer. Parameters that gravity and motion do not excite
    keep their prior values.

    Source: derived here.
    """
    joint_count, symbols = arm.n, (joint_symbols(arm), ca.SX.sym("v", arm.n))
    arms = [arm, *(scale_masses(arm, 1 + _SCALE_STEP * row) for row in np.eye(joint_count))]
    # Evaluated by CasADi's interpreter: the expressions are called only a few times, so compiling them does not pay.
    nominal, *heavier = (
        Kernel("momentum", symbols, [ca.densify(term) for term in momentum_terms(scaled_arm, *symbols)], backend="casadi")
        for scaled_arm in arms
    )
    # Given dry friction is kept, because it decides later whether friction can hold a joint; motion may not reveal it.
    prior = np.r_[
        np.full(joint_count, _MASS_PRIOR_DEVIATION),
        np.where(coulomb > 0, _FIXED_FRICTION_DEVIATION, _FRICTION_PRIOR_DEVIATION),
        np.full(joint_count, _FRICTION_PRIOR_DEVIATION),
    ]
    normal, right_side = np.diag(prior**-2.0), np.zeros(3 * joint_count)
    deviation: FloatArray | None = None
    for log in logs:
        if log.tau is None:
            continue
        residual = partial(_residuals_per_time_constant, segments=[*split_at_gaps(log, complete_row_mask(log))], rate=log.rate)
        nominal_residual = residual(nominal, coulomb, viscous)
        deviation = np.maximum(nominal_residual.std(axis=0), 1e-6) if deviation is None else deviation
        columns = np.zeros((*nominal_residual.shape, 3 * joint_count))
        for index in range(joint_count):
            columns[:, :, index] = (residual(heavier[index], coulomb, viscous) - nominal_residual) / _SCALE_STEP
        # Friction of a joint appears in its own row only.
        joints = np.arange(joint_count)
        columns[:, joints, joint_count + joints] = residual(nominal, coulomb + 1, viscous) - nominal_residual
        columns[:, joints, 2 * joint_count + joints] = residual(nominal, coulomb, viscous + 1) - nominal_residual
        rows = (columns / deviation[:, None]).reshape(-1, 3 * joint_count)
        normal += rows.T @ rows
        right_side -= rows.T @ (nominal_residual / deviation).ravel()
    solution = np.linalg.solve(normal, right_side)
    dry_friction, viscous_friction = coulomb + solution[joint_count : 2 * joint_count], viscous + solution[2 * joint_count :]
    return np.asarray(1 + solution[:joint_count]), np.maximum(dry_friction, 0.0), np.maximum(viscous_friction, 0.0)


def _residuals_per_time_constant(
    kernel: Kernel, coulomb: FloatArray, viscous: FloatArray, *, segments: Sequence[LogSegment], rate: float
) -> FloatArray:
    """Return the residuals of a log, one sample per time constant of the observer."""
    residuals_of = partial(observe_residuals, kernel, dt=1 / rate, coulomb=coulomb, viscous=viscous)
    segment_residuals = [
        residuals_of(segment.q, segment.tau, settling=segment.settling)[0] for segment in segments if segment.tau is not None
    ]
    return np.concatenate([residual[:: max(1, round(rate / OBSERVER_GAIN_PER_S))] for residual in segment_residuals])
