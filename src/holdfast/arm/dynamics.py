"""Symbolic inverse dynamics of a serial arm: the torques of a motion.

The recursion of Newton and Euler runs out along the arm for velocities and accelerations and back for forces, each in the
axes of its own link. It carries no gravity: what gravity asks comes from :mod:`holdfast.arm.statics`, so that the torques
of slow and of fast motions differ by what is computed here and by no rounding of the weight.

Source: English and Maciejewski 1998, eq. (5); Luh, Walker and Paul 1980 for the recursion.
"""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arm import statics
from holdfast.arm.kinematics import Frame, constant, joint_steps, joint_symbols, split
from holdfast.arm.machine import Machine
from holdfast.arm.soundness import require_possible_inertia
from holdfast.errors import InputError
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.kernels.recall import recalled

Array = NDArray[np.float64]


def inverse_dynamics(arm: Machine, q: SX, qd: SX, qdd: SX) -> SX:
    """Torques and forces (n,) of a motion, ``M(q) qdd + C(q, qd) qd + B qd + g(q)``, N m and N; eq. (5).

    Payload and rotor inertias (armature) are in M, viscous friction is B.

    Args:
        arm: The arm; its links may be massless.
        q: (n,) configuration, rad and m.
        qd: (n,) rates, rad/s and m/s.
        qdd: (n,) accelerations, rad/s^2 and m/s^2.

    Raises:
        ArmError: A link of which nothing is known, or whose inertia no body has.
    """
    return sum(_terms(arm, q, qd, qdd))


@recalled
def torque_kernel(arm: Machine) -> Kernel:
    """``(q, qd, qdd) -> inertial, viscous and gravity torques``, each (n,): the terms of :func:`inverse_dynamics`."""
    q, qd, qdd = joint_symbols(arm), ca.SX.sym("qd", arm.n), ca.SX.sym("qdd", arm.n)
    return Kernel("inverse dynamics", [q, qd, qdd], _terms(arm, q, qd, qdd))


def check_states(arm: Machine, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> tuple[list[Array], bool]:
    """Configurations, rates and accelerations, each (N, n) float64, and whether all were single ones.

    What is single, (n,), is used for every row of the others.

    Raises:
        InputError: Shapes that do not fit the arm or one another; NaN or infinity in a single one.
    """
    states: list[Array] = []
    rows: int | None = None
    for name, value in (("q", q), ("qd", qd), ("qdd", qdd)):
        try:
            a = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"{name} for '{arm.name}' must be numbers, {arm.n} per configuration") from error
        if a.ndim not in (1, 2) or a.shape[-1] != arm.n:
            raise InputError(f"{name} for '{arm.name}' has shape {a.shape}; it must be ({arm.n},) or (N, {arm.n})")
        if a.ndim == 1 and not np.isfinite(a).all():
            raise InputError(f"{name} for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
        if a.ndim == 2:
            if rows is not None and len(a) != rows:
                raise InputError(f"{name} for '{arm.name}' has {len(a)} rows and others have {rows}; give as many of each")
            rows = len(a)
        states.append(a)
    return [np.broadcast_to(a, (1 if rows is None else rows, arm.n)) for a in states], rows is None


def _terms(arm: Machine, q: SX, qd: SX, qdd: SX) -> list[SX]:
    gravity = statics.gravity_torques(arm, statics.composite(arm, q))
    return [ca.densify(x) for x in (inertial_torques(arm, q, qd, qdd), viscous_torques(arm, qd), gravity)]


def viscous_torques(arm: Machine, qd: SX) -> SX:
    """Torques and forces (n,) that overcome viscous friction, ``B qd``."""
    return ca.vertcat(*[joint.friction * qd[k] for k, joint in enumerate(arm.joints)])


def inertial_torques(arm: Machine, q: SX, qd: SX, qdd: SX) -> SX:
    """Torques and forces (n,) that accelerate the links, payload and rotors, ``M(q) qdd + C(q, qd) qd``.

    Raises:
        ArmError: A link of which nothing is known, or whose inertia no body has.
    """
    require_possible_inertia(arm)
    steps = joint_steps(arm, q)
    spin, turning, moving = ca.SX(3, 1), ca.SX(3, 1), ca.SX(3, 1)
    forces: list[SX] = []
    couples: list[SX] = []
    for k, (joint, body) in enumerate(zip(arm.joints, statics.bodies(arm), strict=True)):
        # Of the joint's origin as it moves with the link before, then of the link, in the axes of each in turn.
        for turn, shift in (split(joint.origin), steps[k]):
            moving = turn.T @ (moving + _swept(spin, turning, shift))
            spin, turning = turn.T @ spin, turn.T @ turning
        axis = constant(joint.axis)
        if joint.prismatic:
            moving = moving + axis * qdd[k] + 2 * ca.cross(spin, axis) * qd[k]
        else:
            turning = turning + axis * qdd[k] + ca.cross(spin, axis) * qd[k]
            spin = spin + axis * qd[k]
        moment = constant(body.mass * body.com)
        inertia = constant(body.inertia + body.mass * statics.spread(body.com))
        forces.append(body.mass * moving + _swept(spin, turning, moment))
        couples.append(inertia @ turning + ca.cross(spin, inertia @ spin) + ca.cross(moment, moving))
    torques: list[SX] = [None] * arm.n
    force, couple = ca.SX(3, 1), ca.SX(3, 1)  # on the link at its origin, from the links behind it
    for k, joint in reversed(list(enumerate(arm.joints))):
        force, couple = force + forces[k], couple + couples[k]
        torques[k] = ca.dot(constant(joint.axis), force if joint.prismatic else couple) + joint.armature * qdd[k]
        for frame in (steps[k], split(joint.origin)):
            force, couple = _carried(frame, force, couple)
    return ca.vertcat(*torques)


def _swept(spin: SX, turning: SX, r: SX) -> SX:
    """Acceleration of r, fixed in a body that spins and whose spin changes: ``turning x r + spin x (spin x r)``."""
    return ca.cross(turning, r) + ca.cross(spin, ca.cross(spin, r))


def _carried(frame: Frame, force: SX, couple: SX) -> tuple[SX, SX]:
    """A force and a couple at the origin of a frame, as the frame that it is given in sees them."""
    turn, shift = frame
    force = turn @ force
    return force, turn @ couple + ca.cross(shift, force)
