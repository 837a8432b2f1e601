"""Symbolic inverse dynamics of a serial arm: the torques of a motion.

The recursion of Newton and Euler computes velocities and accelerations along the arm outwards, and forces on the way back, each
in the axes of its own link. It contains no gravity, which comes from :mod:`holdfast.model.arm.statics`, so that the torques of
slow and of fast motions differ by the dynamic terms and not by rounding errors of the weight.

Source: English and Maciejewski 1998, eq. (5); Luh, Walker and Paul 1980 for the recursion.
"""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.program import SX
from holdfast.model.arm import statics
from holdfast.model.arm.kinematics import constant_matrix, joint_symbols, joint_transforms, split_transform
from holdfast.model.arm.machine import ArmData
from holdfast.model.arm.soundness import require_possible_inertia


def inverse_dynamics(arm: ArmData, q: SX, qd: SX, qdd: SX) -> SX:
    """Return torques and forces (n,) of a motion, ``M(q) qdd + C(q, qd) qd + B qd + g(q)``, N m and N; eq. (5).

    Payload and rotor inertias (armature) are in M, viscous friction is B.

    Args:
        arm: Arm model; its links may be massless.
        q: (n,) configuration, rad and m.
        qd: (n,) joint rates, rad/s and m/s.
        qdd: (n,) joint accelerations, rad/s^2 and m/s^2.

    Raises:
        ArmError: The mass or inertia of a link is unknown, or impossible for a body.
    """
    return sum(_torque_terms(arm, q, qd, qdd))


@cached_kernel
def torque_terms_kernel(arm: ArmData) -> Kernel:
    """Return the kernel ``(q, qd, qdd) -> inertial, viscous, gravity torques`` (n,): terms of :func:`inverse_dynamics`."""
    q, qd, qdd = joint_symbols(arm), ca.SX.sym("qd", arm.n), ca.SX.sym("qdd", arm.n)
    return Kernel("inverse dynamics", [q, qd, qdd], _torque_terms(arm, q, qd, qdd))


def check_states(arm: ArmData, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> tuple[list[FloatArray], bool]:
    """Return configurations, rates, and accelerations, each (N, n) float64, and whether all of them were single.

    A single array, (n,), is used for every row of the others.

    Raises:
        InputError: Shapes do not fit the arm or one another, or a single array contains NaN or infinity.
    """
    states: list[FloatArray] = []
    row_count: int | None = None
    for name, value in (("q", q), ("qd", qd), ("qdd", qdd)):
        try:
            array = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"{name} for '{arm.name}' must be numbers, {arm.n} per configuration") from error
        if array.ndim not in (1, 2) or array.shape[-1] != arm.n:
            raise InputError(f"{name} for '{arm.name}' has shape {array.shape}; it must be ({arm.n},) or (N, {arm.n})")
        if array.ndim == 1 and not np.isfinite(array).all():
            raise InputError(f"{name} for '{arm.name}' holds NaN or infinity; give {arm.n} finite numbers")
        if array.ndim == 2:
            if row_count is not None and len(array) != row_count:
                raise InputError(
                    f"{name} for '{arm.name}' has {len(array)} rows and others have {row_count}; give as many of each"
                )
            row_count = len(array)
        states.append(array)
    return [np.broadcast_to(array, (1 if row_count is None else row_count, arm.n)) for array in states], row_count is None


def _torque_terms(arm: ArmData, q: SX, qd: SX, qdd: SX) -> list[SX]:
    gravity = statics.gravity_torques(arm, statics.composite_bodies(arm, q))
    return [ca.densify(term) for term in (inertial_torques(arm, q, qd, qdd), viscous_torques(arm, qd), gravity)]


def viscous_torques(arm: ArmData, qd: SX) -> SX:
    """Return torques and forces (n,) that overcome viscous friction, ``B qd``."""
    return ca.vertcat(*[joint.friction * qd[k] for k, joint in enumerate(arm.joints)])


def inertial_torques(arm: ArmData, q: SX, qd: SX, qdd: SX, base_acceleration: ArrayLike = (0.0, 0.0, 0.0)) -> SX:
    """Return torques and forces (n,) that accelerate the links, payload, and rotors, ``M(q) qdd + C(q, qd) qd``.

    The base has an acceleration (3,) in its own axes, m/s^2. With minus gravity, the torques that hold the weight are included.

    Raises:
        ArmError: The mass or inertia of a link is unknown, or impossible for a body.
    """
    require_possible_inertia(arm)
    steps = joint_transforms(arm, q)
    angular_velocity, angular_acceleration = ca.SX(3, 1), ca.SX(3, 1)
    linear_acceleration = constant_matrix(np.asarray(base_acceleration))
    forces: list[SX] = []
    couples: list[SX] = []
    for index, (joint, body) in enumerate(zip(arm.joints, _regrouped_bodies(arm), strict=True)):
        # Of the joint's origin as it moves with the previous link, then of the link, each in its own axes.
        for rotation, offset in (split_transform(joint.origin), steps[index]):
            linear_acceleration = rotation.T @ (
                linear_acceleration + _acceleration_matrix(angular_velocity, angular_acceleration) @ offset
            )
            angular_velocity, angular_acceleration = rotation.T @ angular_velocity, rotation.T @ angular_acceleration
        axis = constant_matrix(joint.axis)
        if joint.prismatic:
            linear_acceleration = linear_acceleration + axis * qdd[index] + 2 * ca.cross(angular_velocity, axis) * qd[index]
        else:
            angular_acceleration = angular_acceleration + axis * qdd[index] + ca.cross(angular_velocity, axis) * qd[index]
            angular_velocity = angular_velocity + axis * qd[index]
        matrix = ca.horzcat(_acceleration_matrix(angular_velocity, angular_acceleration), linear_acceleration)
        product = matrix @ constant_matrix(body)  # the integral of a (r', 1) over the mass, a the acceleration of its point r
        forces.append(product[:, 3])
        couples.append(ca.vertcat(product[2, 1] - product[1, 2], product[0, 2] - product[2, 0], product[1, 0] - product[0, 1]))
    torques: list[SX] = [None] * arm.n
    force, couple = ca.SX(3, 1), ca.SX(3, 1)  # on the link at its origin, from the following links
    for index, joint in reversed(list(enumerate(arm.joints))):
        force, couple = force + forces[index], couple + couples[index]
        torques[index] = ca.dot(constant_matrix(joint.axis), force if joint.prismatic else couple) + joint.armature * qdd[index]
        for frame in (steps[index], split_transform(joint.origin)):
            rotation, offset = frame
            force = rotation @ force  # from here on in the parent frame, with the couple about its origin
            couple = rotation @ couple + ca.cross(offset, force)
    return ca.vertcat(*torques)


def bias_torques(arm: ArmData, q: SX, qd: SX) -> SX:
    """Return torques and forces (n,) of a motion without acceleration and friction, ``C(q, qd) qd + g(q)``, N m and N."""
    return inertial_torques(arm, q, qd, ca.SX(arm.n, 1), -arm.base[:3, :3].T @ arm.gravity)


def _regrouped_bodies(arm: ArmData) -> list[FloatArray]:
    """Return the integral (4, 4) of ``(r; 1) (r; 1)'`` over the mass of each link and payload, in the axes of the link.

    A mass on the axis of a revolute joint moves with the previous link too, so it is counted there. The torques are the same,
    and fewer numbers are not 0.

    Source: Gautier and Khalil 1990.
    """
    bodies: list[FloatArray] = []
    for link in statics.links_with_payload(arm):
        center = np.append(link.com, 1.0)
        bodies.append(link.mass * np.outer(center, center))
        bodies[-1][:3, :3] += np.eye(3) * np.trace(link.inertia) / 2 - link.inertia
    for index, joint in reversed(list(enumerate(arm.joints))):
        if not joint.prismatic:
            projection = np.eye(4)
            projection[:3, :3] = np.outer(joint.axis, joint.axis)
            on_axis = projection @ bodies[index] @ projection
            bodies[index] = bodies[index] - on_axis
            if index:
                bodies[index - 1] = bodies[index - 1] + joint.origin @ on_axis @ joint.origin.T
    return bodies


def _acceleration_matrix(angular_velocity: SX, angular_acceleration: SX) -> SX:
    """Return the matrix (3, 3) of ``alpha x r + omega x (omega x r)``, the acceleration of a point r of a rotating body."""
    others = constant_matrix(1 - np.eye(3))
    products = others * (angular_velocity @ angular_velocity.T)
    return ca.skew(angular_acceleration) + products - ca.diag(others @ angular_velocity**2)
