"""Momentum observer, which estimates the torque on each joint that the model of the arm does not explain.

With ``p = M(q) v`` and ``dp/dt = tau + dT/dq - g - F(v) + tau_x``, it tracks the momentum. The correction that it needs is the
residual: ``s' = tau + dT/dq - g - F(v) + r``, ``r = K_O (p - s)``. The impact of a locking joint appears in its own row only.

Source: De Luca et al. 2006; Haddadin, De Luca and Albu-Schaeffer, IEEE T-RO 33(6), 2017. The common filter of rates and torques
is ours; without it, acceleration would appear as torque.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.model.arm import statics
from holdfast.model.arm.dynamics import inertial_torques
from holdfast.model.arm.kinematics import joint_symbols
from holdfast.model.arm.machine import ArmData

OBSERVER_GAIN_PER_S = 40.0  # 1/s, K_O
FILTER_BANDWIDTH_RAD_S = 2 * np.pi * 20  # rad/s, of the filter on rates and torques
LEVEL_BANDWIDTH_RAD_S = 1 / 0.15  # rad/s, of the filter that computes the level of a residual
FRICTION_TRANSITION_RATE = 0.02  # rad/s or m/s, scale of the rate over which dry friction changes its sign


@cached_kernel
def momentum_kernel(arm: ArmData) -> Kernel:
    """Return the kernel ``(q, v) -> p, dT/dq, g``, each (n,): momentum, gradient of the kinetic energy, gravity torques; rotors
    included.
    """
    q, v = joint_symbols(arm), ca.SX.sym("v", arm.n)
    return Kernel("momentum", [q, v], [ca.densify(term) for term in momentum_terms(arm, q, v)])


def momentum_terms(arm: ArmData, q: SX, v: SX) -> tuple[SX, SX, SX]:
    """Return the outputs of :func:`momentum_kernel` as expressions."""
    momentum = inertial_torques(arm, q, ca.SX.zeros(arm.n), v)
    energy = ca.dot(momentum, v) / 2
    gravity = statics.gravity_torques(arm, statics.composite_bodies(arm, q))
    return momentum, ca.gradient(energy, q), gravity


def friction_torque(v: FloatArray, coulomb: FloatArray, viscous: FloatArray) -> FloatArray:
    """Return the assumed friction, N m or N: dry friction ``coulomb`` and ``viscous`` times the rate, (..., n)."""
    return np.asarray(coulomb * np.tanh(v / FRICTION_TRANSITION_RATE) + viscous * v)


def low_pass(signal: FloatArray, dt: float, band: float, initial: FloatArray) -> FloatArray:
    """Filter a signal (T, n) by ``y += min(1, band dt) (x - y)`` from ``initial`` (n,) on."""
    from scipy.signal import lfilter

    gain = min(1.0, band * dt)
    filtered, _ = lfilter([gain], [1, gain - 1], signal, axis=0, zi=(1 - gain) * initial[None])
    return np.asarray(filtered)


def slow_residual_component(residual: FloatArray, dt: float) -> FloatArray:
    """Return the slowly varying levels (T, n) of residuals (T, n), from 0 on, which errors of the masses cause."""
    return low_pass(residual, dt, LEVEL_BANDWIDTH_RAD_S, np.zeros(residual.shape[1]))


def filtered_rates(q: FloatArray, dt: float, *, moving: bool = False) -> FloatArray:
    """Return filtered rates (T, n) of joint positions (T, n), from rest, or from the first rate if the arm is moving."""
    raw_rates = np.diff(q, axis=0, prepend=q[:1]) / dt
    if moving:
        raw_rates[0] = raw_rates[min(1, len(q) - 1)]
    return low_pass(raw_rates, dt, FILTER_BANDWIDTH_RAD_S, raw_rates[0])


def observe_residuals(
    kernel: Kernel, q: FloatArray, tau: FloatArray, *, dt: float, coulomb: FloatArray, viscous: FloatArray, settling: int = 1
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return residuals, filtered rates, gravity torques, and torques through both filters of a log, (T, n) each.

    The observer is linear in the outputs of the kernel, so it is a filter: ``r_k = (1 - K dt) r_{k-1} + K (p_k - p_{k-1} -
    dt u_k)`` with ``u = tau + dT/dq - g - F``.

    Args:
        kernel: Kernel of :func:`momentum_kernel`.
        q: (T, n) joint positions, rad and m.
        tau: (T, n) commanded torques, N m and N.
        dt: Sampling period, s.
        coulomb: (n,) dry friction, N m and N.
        viscous: (n,) viscous friction, N m s/rad and N s/m.
        settling: Number of rows until residuals begin. With more than one, the arm is already moving in the first row.
    """
    from scipy.signal import lfilter

    rates, torque = filtered_rates(q, dt, moving=settling > 1), low_pass(tau, dt, FILTER_BANDWIDTH_RAD_S, tau[0])
    momentum, energy, gravity = kernel(q, rates)
    known_torque = torque + energy - gravity - friction_torque(rates, coulomb, viscous)
    input_change = np.diff(momentum, axis=0, prepend=momentum[:1]) - dt * known_torque
    input_change[:settling] = 0.0  # the observer starts with r = 0
    residual = np.asarray(lfilter([OBSERVER_GAIN_PER_S], [1, OBSERVER_GAIN_PER_S * dt - 1], input_change, axis=0))
    return residual, rates, gravity, low_pass(torque, dt, OBSERVER_GAIN_PER_S, tau[0])


def accumulate_excess(scaled: FloatArray, dt: float | FloatArray) -> FloatArray:
    """Return the accumulated excess, s, of a signal (T, ...) above 1: ``G <- max(0, G + (z - 1) dt)``; NaN counts as 1."""
    increments = np.nan_to_num(np.asarray(scaled) - 1.0, nan=0.0, posinf=0.0) * dt
    total = np.cumsum(increments, axis=0)
    return np.asarray(total - np.minimum(np.minimum.accumulate(total, axis=0), 0.0))
