"""The three measures of every joint, and the derivatives that English and Maciejewski 1998 give for them, as symbols.

A formula takes the arm and q and returns what each joint's failure brings (n,) and which joints are degenerate (n,): 1
where the measure has no meaning there and is 0 by convention.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass

import casadi as ca
import numpy as np

from holdfast.arm import statics
from holdfast.arm.model import Arm
from holdfast.arm.soundness import require_masses, require_possible_inertia
from holdfast.arm.statics import Composite
from holdfast.errors import ArmError
from holdfast.kernels.program import SX

DEGENERATE = 1e-9
"""A joint is balanced, or vertical, if its lever arm, or gravity across its axis, is this small against the arm."""


@dataclass(frozen=True)
class Formula:
    """A measure: its symbols, its derivatives as the paper prints them, and its words.

    Attributes:
        name: For people.
        source: Paper and equations.
        turning, sliding: Unit of the measure of a revolute and of a prismatic joint.
        slides: Defined for prismatic joints too.
        check: Raises ArmError for an arm that has no such measure.
        values: ``(arm, q) -> f (n,), degenerate (n,)``.
        jacobian: ``(arm, q) -> Df (n, n)`` by the paper's formulas, for configurations without a degenerate joint.
    """

    name: str
    source: str
    turning: str
    _: KW_ONLY
    sliding: str
    slides: bool
    check: Callable[[Arm], None]
    values: Callable[[Arm, SX], tuple[SX, SX]]
    jacobian: Callable[[Arm, SX], SX]


# ---- torque --------------------------------------------------------------------------------------------------------


def _torque(arm: Arm, q: SX) -> tuple[SX, SX]:
    """Eq. (7), (8), (12)."""
    return statics.gravity_torques(arm, statics.composite(arm, q)), ca.DM.zeros(arm.n)


def _torque_slope(arm: Arm, w: Composite, i: int, j: int) -> SX:
    """``d tau_i / d q_j``; eq. (11), (13)."""
    z, s, g = w.axes[i], w.moments[i], w.gravity[i]
    dz = statics.axis_derivative(arm, w, i, j)
    if arm.joints[i].prismatic:
        return w.masses[i] * ca.dot(dz, g)
    ds = statics.moment_derivative(arm, w, i, j)
    return ca.dot(dz, ca.cross(s, g)) + ca.dot(z, ca.cross(ds, g))


def _torque_jacobian(arm: Arm, q: SX) -> SX:
    w = statics.in_world(statics.composite(arm, q))
    return _matrix(arm.n, lambda i, j: _torque_slope(arm, w, i, j))


# ---- acceleration --------------------------------------------------------------------------------------------------


def _require_inertia(arm: Arm) -> None:
    require_possible_inertia(arm)
    mass = sum(body.mass for body in statics.bodies(arm))
    for joint, body in zip(arm.joints, statics.bodies(arm), strict=True):
        if mass <= 0 and joint.armature == 0:
            raise ArmError(
                f"arm '{arm.name}': nothing behind joint '{joint.name}' has mass, so its acceleration after a failure is not "
                "defined; give the links after it their masses, or the joint an armature"
            )
        mass -= body.mass


def _acceleration(arm: Arm, q: SX) -> tuple[SX, SX]:
    """Eq. (22); NaN for a revolute joint on whose axis all the mass it carries lies."""
    c = statics.composite(arm, q)
    tau, m = statics.gravity_torques(arm, c), statics.inertia_diagonal(arm, c)
    length = statics.length_scale(arm)
    for i, joint in enumerate(arm.joints):
        if not joint.prismatic:
            m[i] = ca.if_else(m[i] <= DEGENERATE * c.masses[i] * length**2, np.nan, m[i])
    return -tau / m, ca.DM.zeros(arm.n)


def _acceleration_jacobian(arm: Arm, q: SX) -> SX:
    """Eq. (24)."""
    c = statics.composite(arm, q)
    w, tau, m = statics.in_world(c), statics.gravity_torques(arm, c), statics.inertia_diagonal(arm, c)

    def entry(i: int, j: int) -> SX:
        rise = m[i] * _torque_slope(arm, w, i, j) - tau[i] * statics.inertia_derivative(arm, w, i, j)
        return -rise / (m[i] * m[i])

    return _matrix(arm.n, entry)


# ---- swing angle ---------------------------------------------------------------------------------------------------


def _swing(arm: Arm, q: SX) -> tuple[SX, SX]:
    """Eq. (36)-(39), (42), (43)."""
    c = statics.composite(arm, q)
    length, weight = statics.length_scale(arm), float(np.linalg.norm(arm.gravity))
    angles, flags = [], []
    for i, joint in enumerate(arm.joints):
        z, s, g = c.axes[i], c.moments[i], c.gravity[i]
        if joint.prismatic:
            angles.append(ca.SX(0))
            flags.append(ca.SX(1))
            continue
        u, v = ca.cross(s, z), ca.cross(z, g)
        balanced = ca.sumsqr(u) <= (DEGENERATE * c.masses[i] * length) ** 2
        upright = ca.sumsqr(v) <= (DEGENERATE * weight) ** 2
        degenerate = ca.logic_or(balanced, upright)
        # The arguments are replaced rather than the result, so that the derivative is 0 there too and never 0/0.
        angle = ca.atan2(ca.if_else(degenerate, 0, -ca.dot(z, ca.cross(s, g))), ca.if_else(degenerate, 1, ca.dot(u, v)))
        # -pi and pi are one and the same rest; adding a turn keeps the derivative.
        angles.append(angle + ca.if_else(angle <= -np.pi, 2 * np.pi, 0))
        flags.append(degenerate)
    return ca.vertcat(*angles), ca.vertcat(*flags)


def _swing_jacobian(arm: Arm, q: SX) -> SX:
    """Eq. (41)-(45)."""
    w = statics.in_world(statics.composite(arm, q))

    def entry(i: int, j: int) -> SX:
        if arm.joints[i].prismatic:
            return ca.SX(0)
        z, s, g = w.axes[i], w.moments[i], w.gravity[i]
        dz, ds = statics.axis_derivative(arm, w, i, j), statics.moment_derivative(arm, w, i, j)
        a, b = -ca.dot(z, ca.cross(s, g)), ca.dot(ca.cross(s, z), ca.cross(z, g))
        da = -_torque_slope(arm, w, i, j)
        db = ca.dot(ca.cross(ds, z) + ca.cross(s, dz), ca.cross(z, g)) + ca.dot(ca.cross(s, z), ca.cross(dz, g))
        return (b * da - a * db) / (a * a + b * b)

    return _matrix(arm.n, entry)


def _matrix(n: int, entry: Callable[[int, int], SX]) -> SX:
    return ca.vertcat(*[ca.horzcat(*[entry(i, j) for j in range(n)]) for i in range(n)])


PAPER = "English and Maciejewski 1998"
TORQUE = Formula(
    "torque",
    f"{PAPER}, eq. (7), (8), (12)",
    "N m",
    sliding="N",
    slides=True,
    check=require_masses,
    values=_torque,
    jacobian=_torque_jacobian,
)
ACCELERATION = Formula(
    "acceleration",
    f"{PAPER}, eq. (22)",
    "rad/s^2",
    sliding="m/s^2",
    slides=True,
    check=_require_inertia,
    values=_acceleration,
    jacobian=_acceleration_jacobian,
)
SWING_ANGLE = Formula(
    "swing angle",
    f"{PAPER}, eq. (38), (39)",
    "rad",
    sliding="rad",
    slides=False,
    check=require_masses,
    values=_swing,
    jacobian=_swing_jacobian,
)
