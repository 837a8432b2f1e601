"""Symbolic formulas of the three measures of every joint and of their derivatives (English and Maciejewski 1998).

A formula takes the arm and q and returns the effect of each joint's failure (n,) and which joints are degenerate (n,): 1 where
the measure is not defined and is 0 by convention.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass

import casadi as ca
import numpy as np

from holdfast.core.errors import ArmError
from holdfast.kernels.program import SX
from holdfast.model.arm import statics
from holdfast.model.arm.model import Arm
from holdfast.model.arm.soundness import require_masses, require_possible_inertia
from holdfast.model.arm.statics import CompositeBodies

DEGENERATE_RATIO = 1e-9
"""A joint is balanced, or vertical, if its lever arm, or gravity across its axis, is this small relative to the arm."""


Total = Callable[[Arm, SX, SX], SX]


@dataclass(frozen=True)
class SusceptibilityFormula:
    """Measure of a susceptibility: its symbols, its derivatives as printed in the paper, and its descriptions.

    Attributes:
        name: Name for people.
        source: Paper and equations.
        turning, sliding: Unit of the measure for a revolute and for a prismatic joint.
        slides: True if the measure is defined for prismatic joints.
        check: Function that raises ArmError for an arm without such a measure.
        values: Function ``(arm, q) -> f (n,), degenerate (n,)``.
        jacobian: Function ``(arm, q) -> Df (n, n)`` by the paper's formulas, for configurations without a degenerate joint.
            None if the paper has none.
        total: Function ``(arm, q, f) -> value`` that replaces ``f' W f``; None if the measure has weights.
        total_unit: Unit of ``total``.
    """

    name: str
    source: str
    turning: str
    _: KW_ONLY
    sliding: str
    slides: bool
    check: Callable[[Arm], None]
    values: Callable[[Arm, SX], tuple[SX, SX]]
    jacobian: Callable[[Arm, SX], SX] | None = None
    total: Total | None = None
    total_unit: str = ""


# ---- torque --------------------------------------------------------------------------------------------------------


def _holding_torques_and_status(arm: Arm, q: SX) -> tuple[SX, SX]:
    """Return the holding torques and their status; eq. (7), (8), (12)."""
    return statics.gravity_torques(arm, statics.composite_bodies(arm, q)), ca.DM.zeros(arm.n)


def _torque_derivative(arm: Arm, w: CompositeBodies, i: int, j: int) -> SX:
    """Return ``d tau_i / d q_j``; eq. (11), (13)."""
    z, s, g = w.axes[i], w.moments[i], w.gravity[i]
    dz = statics.axis_derivative(arm, w, i, j)
    if arm.joints[i].prismatic:
        return w.masses[i] * ca.dot(dz, g)
    ds = statics.moment_derivative(arm, w, i, j)
    return ca.dot(dz, ca.cross(s, g)) + ca.dot(z, ca.cross(ds, g))


def _torque_jacobian(arm: Arm, q: SX) -> SX:
    w = statics.express_in_world(statics.composite_bodies(arm, q))
    return _symbolic_matrix(arm.n, lambda i, j: _torque_derivative(arm, w, i, j))


# ---- acceleration --------------------------------------------------------------------------------------------------


def require_inertia(arm: Arm, free: tuple[int, ...] | None = None) -> None:
    """Raise :class:`ArmError` if one of the joints ``free`` (indices from 0, default all) carries no mass and has no rotor."""
    require_possible_inertia(arm)
    masses = [body.mass for body in statics.links_with_payload(arm)]
    for k in range(arm.n) if free is None else free:
        joint = arm.joints[k]
        if sum(masses[k:]) <= 0 and joint.armature == 0:
            raise ArmError(
                f"arm '{arm.name}': nothing behind joint '{joint.name}' has mass, so its acceleration after a failure is not "
                "defined; give the links after it their masses, or the joint an armature"
            )


def _failure_accelerations_and_status(arm: Arm, q: SX) -> tuple[SX, SX]:
    """Return the accelerations, eq. (22); NaN for a revolute joint on whose axis all the carried mass lies."""
    c = statics.composite_bodies(arm, q)
    tau, m = statics.gravity_torques(arm, c), statics.inertia_diagonal(arm, c)
    length = statics.length_scale(arm)
    for i, joint in enumerate(arm.joints):
        if not joint.prismatic:
            m[i] = ca.if_else(m[i] <= DEGENERATE_RATIO * c.masses[i] * length**2, np.nan, m[i])
    return -tau / m, ca.DM.zeros(arm.n)


def _acceleration_jacobian(arm: Arm, q: SX) -> SX:
    """Return the derivatives of the accelerations, eq. (24)."""
    c = statics.composite_bodies(arm, q)
    w, tau, m = statics.express_in_world(c), statics.gravity_torques(arm, c), statics.inertia_diagonal(arm, c)

    def entry(i: int, j: int) -> SX:
        rise = m[i] * _torque_derivative(arm, w, i, j) - tau[i] * statics.inertia_derivative(arm, w, i, j)
        return -rise / (m[i] * m[i])

    return _symbolic_matrix(arm.n, entry)


# ---- swing angle ---------------------------------------------------------------------------------------------------


def _swing_angles_and_status(arm: Arm, q: SX) -> tuple[SX, SX]:
    """Return the swing angles; eq. (36)-(39), (42), (43)."""
    c = statics.composite_bodies(arm, q)
    length, weight = statics.length_scale(arm), float(np.linalg.norm(arm.gravity))
    angles, flags = [], []
    for i, joint in enumerate(arm.joints):
        z, s, g = c.axes[i], c.moments[i], c.gravity[i]
        if joint.prismatic:
            angles.append(ca.SX(0))
            flags.append(ca.SX(1))
            continue
        u, v = ca.cross(s, z), ca.cross(z, g)
        balanced = ca.sumsqr(u) <= (DEGENERATE_RATIO * c.masses[i] * length) ** 2
        upright = ca.sumsqr(v) <= (DEGENERATE_RATIO * weight) ** 2
        degenerate = ca.logic_or(balanced, upright)
        # The arguments are replaced rather than the result, so that the derivative is 0 as well and never 0/0.
        angle = ca.atan2(ca.if_else(degenerate, 0, -ca.dot(z, ca.cross(s, g))), ca.if_else(degenerate, 1, ca.dot(u, v)))
        # -pi and pi are the same angle; adding a full turn keeps the derivative.
        angles.append(angle + ca.if_else(angle <= -np.pi, 2 * np.pi, 0))
        flags.append(degenerate)
    return ca.vertcat(*angles), ca.vertcat(*flags)


def _swing_jacobian(arm: Arm, q: SX) -> SX:
    """Return the derivatives of the swing angles, eq. (41)-(45)."""
    w = statics.express_in_world(statics.composite_bodies(arm, q))

    def entry(i: int, j: int) -> SX:
        if arm.joints[i].prismatic:
            return ca.SX(0)
        z, s, g = w.axes[i], w.moments[i], w.gravity[i]
        dz, ds = statics.axis_derivative(arm, w, i, j), statics.moment_derivative(arm, w, i, j)
        a, b = -ca.dot(z, ca.cross(s, g)), ca.dot(ca.cross(s, z), ca.cross(z, g))
        da = -_torque_derivative(arm, w, i, j)
        db = ca.dot(ca.cross(ds, z) + ca.cross(s, dz), ca.cross(z, g)) + ca.dot(ca.cross(s, z), ca.cross(dz, g))
        return (b * da - a * db) / (a * a + b * b)

    return _symbolic_matrix(arm.n, entry)


def _symbolic_matrix(n: int, entry: Callable[[int, int], SX]) -> SX:
    return ca.vertcat(*[ca.horzcat(*[entry(i, j) for j in range(n)]) for i in range(n)])


SOURCE_PAPER = "English and Maciejewski 1998"
TORQUE_FORMULA = SusceptibilityFormula(
    "torque",
    f"{SOURCE_PAPER}, eq. (7), (8), (12)",
    "N m",
    sliding="N",
    slides=True,
    check=require_masses,
    values=_holding_torques_and_status,
    jacobian=_torque_jacobian,
)
ACCELERATION_FORMULA = SusceptibilityFormula(
    "acceleration",
    f"{SOURCE_PAPER}, eq. (22)",
    "rad/s^2",
    sliding="m/s^2",
    slides=True,
    check=require_inertia,
    values=_failure_accelerations_and_status,
    jacobian=_acceleration_jacobian,
)
SWING_ANGLE_FORMULA = SusceptibilityFormula(
    "swing angle",
    f"{SOURCE_PAPER}, eq. (38), (39)",
    "rad",
    sliding="rad",
    slides=False,
    check=require_masses,
    values=_swing_angles_and_status,
    jacobian=_swing_jacobian,
)
