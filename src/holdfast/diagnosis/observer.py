"""The momentum observer: the torque on each joint that the model of the arm does not know.

With ``p = M(q) v`` and ``dp/dt = tau + dT/dq - g - F(v) + tau_x`` it follows the momentum, and what it must add is the
residual: ``s' = tau + dT/dq - g - F(v) + r``, ``r = K_O (p - s)``. The jolt of a joint that locks is on its own row alone.

Source: De Luca et al. 2006; Haddadin, De Luca and Albu-Schaeffer, IEEE T-RO 33(6), 2017. That rate and torque go through the
same filter is ours: else acceleration shows as torque.
"""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm import statics
from holdfast.arm.dynamics import inertial_torques
from holdfast.arm.kinematics import joint_symbols
from holdfast.arm.machine import Machine
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled

Array = NDArray[np.float64]

GAIN = 40.0  # 1/s, K_O
BAND = 2 * np.pi * 20  # rad/s, of the filter on rates and torques
LEVEL = 1 / 0.15  # rad/s, of the filter that the level of a residual goes through
SLIP = 0.02  # rad/s or m/s: dry friction has turned its sign within about so much


@recalled
def momentum_kernel(arm: Machine) -> Kernel:
    """``(q, v) -> p, dT/dq, g``, each (n,): momentum, what kinetic energy gives, gravity torques; rotors included."""
    q, v = joint_symbols(arm), ca.SX.sym("v", arm.n)
    return Kernel("momentum", [q, v], [ca.densify(x) for x in momentum_terms(arm, q, v)])


def momentum_terms(arm: Machine, q: SX, v: SX) -> tuple[SX, SX, SX]:
    """The outputs of :func:`momentum_kernel` as expressions."""
    p = inertial_torques(arm, q, ca.SX.zeros(arm.n), v)
    energy = ca.dot(p, v) / 2
    gravity = statics.gravity_torques(arm, statics.composite(arm, q))
    return p, ca.gradient(energy, q), gravity


def friction_torque(v: Array, coulomb: Array, viscous: Array) -> Array:
    """What friction is taken for, N m or N: dry of ``coulomb`` and ``viscous`` times the rate, (..., n)."""
    return np.asarray(coulomb * np.tanh(v / SLIP) + viscous * v)


def low_passed(signal: Array, dt: float, band: float, initial: Array) -> Array:
    """A signal (T, n) through ``y += min(1, band dt) (x - y)`` from ``initial`` (n,) on."""
    from scipy.signal import lfilter

    a = min(1.0, band * dt)
    out, _ = lfilter([a], [1, a - 1], signal, axis=0, zi=(1 - a) * initial[None])
    return np.asarray(out)


def level(r: Array, dt: float) -> Array:
    """(T, n) levels of residuals (T, n), from 0 on: what masses that are off make of them, slow beside a fault or a push."""
    return low_passed(r, dt, LEVEL, np.zeros(r.shape[1]))


def filtered_rates(q: Array, dt: float, *, moving: bool = False) -> Array:
    """(T, n) rates of joint values (T, n), from rest, or from the first rate of a joint that is moving."""
    steps = np.diff(q, axis=0, prepend=q[:1]) / dt
    if moving:
        steps[0] = steps[min(1, len(q) - 1)]
    return low_passed(steps, dt, BAND, steps[0])


def residuals(
    kernel: Kernel, q: Array, tau: Array, *, dt: float, coulomb: Array, viscous: Array, settling: int = 1
) -> tuple[Array, Array, Array, Array]:
    """Residuals, filtered rates, gravity torques, and torques through both filters of a record, (T, n) each.

    The observer is linear in what the kernel gives, and so a filter: ``r_k = (1 - K dt) r_{k-1} + K (p_k - p_{k-1} - dt u_k)``
    with ``u = tau + dT/dq - g - F``.

    Args:
        kernel: Of :func:`momentum_kernel`.
        q: (T, n) rad and m.
        tau: (T, n) N m and N.
        dt: s.
        coulomb: (n,) dry friction, N m and N.
        viscous: (n,) N m s/rad and N s/m.
        settling: Rows until residuals begin; with more than one the record begins in the midst of motion.
    """
    from scipy.signal import lfilter

    v, torque = filtered_rates(q, dt, moving=settling > 1), low_passed(tau, dt, BAND, tau[0])
    p, energy, gravity = kernel(q, v)
    change = np.diff(p, axis=0, prepend=p[:1]) - dt * (torque + energy - gravity - friction_torque(v, coulomb, viscous))
    change[:settling] = 0.0  # it begins with r = 0
    return np.asarray(lfilter([GAIN], [1, GAIN * dt - 1], change, axis=0)), v, gravity, low_passed(torque, dt, GAIN, tau[0])


def excess(z: Array, dt: float | Array) -> Array:
    """Seconds of excess of a signal (T, ...) above 1: ``G <- max(0, G + (z - 1) dt)``; NaN counts as 1."""
    step = np.nan_to_num(np.asarray(z) - 1.0, nan=0.0, posinf=0.0) * dt
    total = np.cumsum(step, axis=0)
    return np.asarray(total - np.minimum(np.minimum.accumulate(total, axis=0), 0.0))
