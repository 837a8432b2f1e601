"""Symbolic statics and inertia of a serial arm: holding torques and the inertia about each joint.

Joint i carries a *composite body*: the following links and the payload, as if they were welded together. English and
Maciejewski 1998 compute its mass, first and second moment by a recursion from the tip, eq. (9), (10), (26), (27), each in the
axes of its own link, where joint axes and link data are constant numbers. For the Panda (measured) all three susceptibilities
with their gradients take 1,600 operations in this form, and 3,900 as sums in one common frame.

The paper's closed-form derivatives, eq. (14)-(17) and (31)-(35), need all vectors in one frame: :func:`express_in_world`.

Source: English, Maciejewski 1998. The paper's upward vector g is minus the arm's gravity; the sign changes only here.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kernels.program import SX
from holdfast.model.arm.kinematics import (
    body_and_joint_frames,
    constant_matrix,
    identity_matrix,
    joint_transforms,
    split_transform,
)
from holdfast.model.arm.machine import ArmData, Link
from holdfast.model.arm.soundness import require_masses, require_possible_inertia


@dataclass(frozen=True)
class CompositeBodies:
    """Composite body of every joint, as functions of q; entry i belongs to joint i.

    Vectors are in the axes of link i, or all in those of the world after :func:`express_in_world`. O is the origin of the
    joint's frame, a point on its axis that the joint itself does not move.

    Attributes:
        axes: Unit vectors (3,) of the joint axes.
        masses: Masses, kg, eq. (9).
        moments: First moments (3,) about O, kg m, eq. (10).
        inertias: Second moments (3, 3) about O, kg m^2, eq. (26), (27).
        gravity: Upward vectors g (3,), m/s^2.
        rotations: Rotation (3, 3) of each link in the world.
        points: Points O (3,) in the world, m.
    """

    axes: list[SX]
    masses: list[float]
    moments: list[SX]
    inertias: list[SX]
    gravity: list[SX]
    rotations: list[SX]
    points: list[SX]


def composite_bodies(arm: ArmData, q: SX) -> CompositeBodies:
    """Compute the composite body of every joint, each in the axes of its own link.

    Raises:
        ArmError: The mass of a link is unknown.
    """
    require_masses(arm)
    n = arm.n
    steps = joint_transforms(arm, q)
    body_frames, joint_frames = body_and_joint_frames(arm, steps)
    rotations, points = [rotation for rotation, _ in body_frames[1:]], [position for _, position in joint_frames]
    gravity: list[SX] = []
    upward = constant_matrix(-arm.base[:3, :3].T @ arm.gravity)  # in the base's axes, so that a tilted base adds no operations
    for joint, step in zip(arm.joints, steps, strict=True):
        upward = step[0].T @ (split_transform(joint.origin)[0].T @ upward)
        gravity.append(upward)
    masses, moments, inertias = [0.0] * n, [ca.SX(3, 1)] * n, [ca.SX(3, 3)] * n
    mass, moment, inertia = 0.0, ca.SX(3, 1), ca.SX(3, 3)
    for i, link in reversed(list(enumerate(links_with_payload(arm)))):
        if i < n - 1:  # from the axes of link i + 1, about its joint, to those of link i, about its origin
            link_rotation, offset = split_transform(arm.joints[i + 1].origin)
            for factor in (steps[i + 1][0], link_rotation):
                moment, inertia = factor @ moment, _rotate_inertia(inertia, factor)
            moment, inertia = _shift_moments(mass, moment, inertia, offset)
        mass = mass + link.mass
        moment = moment + constant_matrix(link.mass * link.com)
        inertia = inertia + constant_matrix(link.inertia + link.mass * unit_second_moment(link.com))
        moment, inertia = _shift_moments(mass, moment, inertia, steps[i][1])  # a prismatic joint has moved its link away from O
        masses[i], moments[i], inertias[i] = mass, moment, inertia
    axes = [constant_matrix(joint.axis) for joint in arm.joints]
    return CompositeBodies(axes, masses, moments, inertias, gravity, rotations, points)


def links_with_payload(arm: ArmData) -> list[Link]:
    """Return the links of an arm with known links, with the payload merged into the last link."""
    links = [link for link in arm.links if link is not None]
    if arm.payload is not None:
        links[-1] = Link.merge([links[-1], arm.payload])
    return links


def length_scale(arm: ArmData) -> float:
    """Return a length, m, for relative tolerances of first moments: link lengths and the largest offset of a center of mass."""
    reach = sum(float(np.linalg.norm(joint.origin[:3, 3])) for joint in arm.joints[1:])
    travels = [max(abs(j.lower), abs(j.upper)) for j in arm.joints if j.prismatic]
    reach += sum(travel for travel in travels if np.isfinite(travel))
    return reach + max(float(np.linalg.norm(link.com)) for link in links_with_payload(arm))


def torque_scale(arm: ArmData) -> FloatArray:
    """Return a bound of the order of each joint's largest gravity torque (n,), N m and N, for relative tolerances."""
    carried = np.cumsum([body.mass for body in links_with_payload(arm)][::-1])[::-1]
    lengths = [1.0 if joint.prismatic else length_scale(arm) for joint in arm.joints]
    return np.asarray(carried * float(np.linalg.norm(arm.gravity)) * lengths)


def gravity_torques(arm: ArmData, c: CompositeBodies) -> SX:
    """Return torques and forces (n,) that hold the arm still against gravity, N m and N; eq. (8), (12)."""
    return ca.vertcat(*[ca.dot(first_moment_rate(arm, c, i), c.gravity[i]) for i in range(arm.n)])


def first_moment_rate(arm: ArmData, c: CompositeBodies, i: int) -> SX:
    """Return the rate (3,) of the first moment beyond joint i: ``z x s`` for a revolute joint, ``M z`` for a prismatic one.

    Its product with g is the torque, ``z . (s x g) = (z x s) . g``; eq. (15), (17).
    """
    return c.masses[i] * c.axes[i] if arm.joints[i].prismatic else ca.cross(c.axes[i], c.moments[i])


def inertia_diagonal(arm: ArmData, c: CompositeBodies) -> SX:
    """Return the diagonal of the joint-space inertia matrix (n,), kg m^2 and kg, armature included; eq. (25), (28).

    Raises:
        ArmError: The inertia of a link is impossible for a body.
    """
    require_possible_inertia(arm)
    entries = []
    for i, joint in enumerate(arm.joints):
        z = c.axes[i]
        body = ca.SX(c.masses[i]) if joint.prismatic else ca.dot(z, c.inertias[i] @ z)
        entries.append(body + joint.armature)
    return ca.vertcat(*entries)


def inertia_matrix(arm: ArmData, q: SX) -> SX:
    """Return the joint-space inertia matrix (n, n), kg m^2, kg m and kg, armature included.

    Column j contains the force and couple that give the composite body of joint j a unit acceleration of that joint. They act
    on all earlier links, so they are expressed in the axes of one link after the other down to the base.

    Source: Featherstone 2008, section 6.2.

    Raises:
        ArmError: The mass or inertia of a link is unknown, or impossible for a body.
    """
    require_possible_inertia(arm)
    bodies, steps = composite_bodies(arm, q), joint_transforms(arm, q)
    matrix = ca.SX(arm.n, arm.n)
    for j, joint in enumerate(arm.joints):
        axis = bodies.axes[j]
        force = first_moment_rate(arm, bodies, j)
        couple = ca.cross(bodies.moments[j], axis) if joint.prismatic else bodies.inertias[j] @ axis
        matrix[j, j] = ca.dot(axis, force if joint.prismatic else couple) + joint.armature
        for i in reversed(range(j)):  # to the axes of link i, about O of joint i
            link_rotation, offset = split_transform(arm.joints[i + 1].origin)
            force, couple = (link_rotation @ (steps[i + 1][0] @ vector) for vector in (force, couple))
            couple = couple + ca.cross(offset + steps[i][1], force)
            matrix[i, j] = matrix[j, i] = ca.dot(bodies.axes[i], force if arm.joints[i].prismatic else couple)
    return matrix


def potential_energy(c: CompositeBodies) -> SX:
    """Return the potential energy of all links and the payload, J, up to a constant."""
    return ca.dot(c.gravity[0], c.moments[0])


# ---- the paper's derivatives, all vectors in the world's axes --------------------------------------------------------


def express_in_world(c: CompositeBodies) -> CompositeBodies:
    """Return the same bodies with every vector in the world's axes."""
    indices = range(len(c.axes))
    return CompositeBodies(
        [c.rotations[i] @ c.axes[i] for i in indices],
        c.masses,
        [c.rotations[i] @ c.moments[i] for i in indices],
        [_rotate_inertia(c.inertias[i], c.rotations[i]) for i in indices],
        [c.rotations[0] @ c.gravity[0] for _ in indices],
        c.rotations,
        c.points,
    )


def axis_derivative(arm: ArmData, w: CompositeBodies, i: int, j: int) -> SX:
    """Return ``d z_i / d q_j`` (3,) of bodies in the world; eq. (14), (16)."""
    if j >= i or arm.joints[j].prismatic:
        return ca.SX(3, 1)
    return ca.cross(w.axes[j], w.axes[i])


def moment_derivative(arm: ArmData, w: CompositeBodies, i: int, j: int) -> SX:
    """Return ``d s_i / d q_j`` (3,) of bodies in the world; eq. (15), (17)."""
    if j >= i:
        return first_moment_rate(arm, w, j)
    return ca.SX(3, 1) if arm.joints[j].prismatic else ca.cross(w.axes[j], w.moments[i])


def inertia_derivative(arm: ArmData, w: CompositeBodies, i: int, j: int) -> SX:
    """Return ``d m_ii / d q_j`` of bodies in the world; eq. (31), (33) to (35)."""
    if j <= i or arm.joints[i].prismatic:
        return ca.SX(0)
    z, zj, distance = w.axes[i], w.axes[j], w.points[j] - w.points[i]
    if arm.joints[j].prismatic:
        moment_about_i = w.moments[j] + w.masses[j] * distance
        return 2 * ca.dot(ca.cross(z, zj), ca.cross(z, moment_about_i))
    turning = ca.dot(ca.cross(z, zj), w.inertias[j] @ z)
    return 2 * turning + 2 * ca.dot(ca.cross(z, distance), ca.cross(z, first_moment_rate(arm, w, j)))


def unit_second_moment(r: FloatArray) -> FloatArray:
    """Return ``-[r][r]``, the second moment of a unit mass at r."""
    return np.asarray(r @ r * np.eye(3) - np.outer(r, r))


def _rotate_inertia(inertia: SX, r: SX) -> SX:
    """Return ``R I R'``, computing each entry off the diagonal once."""
    product = r @ inertia
    rotated = ca.SX(3, 3)
    for a in range(3):
        for b in range(a, 3):
            rotated[a, b] = rotated[b, a] = ca.dot(product[a, :], r[b, :])
    return rotated


def _shift_moments(mass: float, moment: SX, inertia: SX, p: SX) -> tuple[SX, SX]:
    """Return moments about a point from which the old one lies at p: ``s + M p``, ``I - [p][s] - [s][p] - M [p][p]``."""
    if p.nnz() == 0:
        return moment, inertia
    outer_product = moment @ p.T
    correction = outer_product + outer_product.T + mass * (p @ p.T)
    return moment + mass * p, inertia + ca.trace(correction) * identity_matrix() - correction
