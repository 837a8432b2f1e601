"""Symbolic kinematics of a serial arm.

All functions take and return CasADi ``SX``. The fixed geometry enters as exact numbers, so terms that vanish for an arm vanish
from its code. If the geometry itself varies (:mod:`holdfast.design`), symbols replace the numbers.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.kernels.program import SX
from holdfast.model.arm.machine import ArmData

Frame = tuple[SX, SX]


@dataclass(frozen=True)
class KinematicChain:
    """Joint axes and tool of an arm in one common frame, as functions of q.

    Attributes:
        axes: n directions (3,) of the joint axes.
        points: n points (3,), one on each axis, m.
        rotation: (3, 3) orientation of the tool.
        position: (3,) tool point, m.
    """

    axes: list[SX]
    points: list[SX]
    rotation: SX
    position: SX


def joint_symbols(arm: ArmData) -> SX:
    """Return symbols of the joint variables, (n,)."""
    return ca.SX.sym("q", arm.n)


def kinematic_chain(arm: ArmData, q: SX, frame: int | None = None, steps: list[Frame] | None = None) -> KinematicChain:
    """Compute the joint axes and the tool pose in one common frame.

    Args:
        arm: Arm model.
        q: (n,) joint variables.
        frame: None for the world. k from 0 to n for the frame that moves with joint k - 1 (0: the arm's base), in which the
            axes near joint k are simple. The choice changes no invariant index, only the length of its code.
        steps: :func:`joint_transforms` of the same q, if several chains are made.
    """
    body_frames, joint_frames = body_and_joint_frames(arm, joint_transforms(arm, q) if steps is None else steps, frame)
    axes = [rotation @ constant_matrix(joint.axis) for (rotation, _), joint in zip(joint_frames, arm.joints, strict=True)]
    return KinematicChain(
        axes, [position for _, position in joint_frames], *compose_frames(body_frames[-1], split_transform(arm.tool))
    )


def body_and_joint_frames(arm: ArmData, steps: list[Frame], frame: int | None = None) -> tuple[list[Frame], list[Frame]]:
    """Compute rotation (3, 3) and origin (3,) of every body and every joint.

    Args:
        arm: Arm model.
        steps: :func:`joint_transforms`.
        frame: Frame of the results; see :func:`kinematic_chain`.

    Returns:
        The n + 1 frames of the base and of the body that moves with each joint; and the n joint frames, which are not moved by
            their own joint.
    """
    n, start = arm.n, 0 if frame is None else frame
    body_frames: dict[int, Frame] = {start: split_transform(arm.base) if frame is None else (identity_matrix(), ca.SX(3, 1))}
    joint_frames: dict[int, Frame] = {}
    for index in range(start, n):
        joint_frames[index] = compose_frames(body_frames[index], split_transform(arm.joints[index].origin))
        body_frames[index + 1] = compose_frames(joint_frames[index], steps[index])
    for index in reversed(range(start)):
        joint_frames[index] = compose_frames(body_frames[index + 1], _invert_frame(steps[index]))
        body_frames[index] = compose_frames(joint_frames[index], _invert_frame(split_transform(arm.joints[index].origin)))
    return [body_frames[index] for index in range(n + 1)], [joint_frames[index] for index in range(n)]


def body_poses(arm: ArmData, q: SX) -> SX:
    """Return the world poses (3 (n + 2), 4), each (3, 4): of the base, of the link moved by each joint, and of the tool."""
    body_frames, _ = body_and_joint_frames(arm, joint_transforms(arm, q))
    tool_frame = compose_frames(body_frames[-1], split_transform(arm.tool))
    return ca.densify(ca.vertcat(*[ca.horzcat(*pose) for pose in [*body_frames, tool_frame]]))


def tool_pose(arm: ArmData, q: SX) -> SX:
    """Return the tool pose in the world, (4, 4)."""
    geometry = kinematic_chain(arm, q)
    return ca.vertcat(ca.horzcat(geometry.rotation, geometry.position), ca.horzcat(ca.SX(1, 3), 1))


def chain_jacobian(arm: ArmData, geometry: KinematicChain, reference_point: SX) -> SX:
    """Return the geometric Jacobian (6, n), rows (linear; angular) in the chain's frame, for the velocity of
    ``reference_point``.

    Source: the column of a revolute joint is ``(z x (p - p_k); z)``, of a prismatic joint ``(z; 0)``.
    """
    columns = []
    for index, joint in enumerate(arm.joints):
        axis = geometry.axes[index]
        if joint.prismatic:
            columns.append(ca.vertcat(axis, ca.SX(3, 1)))
        else:
            columns.append(ca.vertcat(ca.cross(axis, reference_point - geometry.points[index]), axis))
    return ca.horzcat(*columns)


def world_jacobian(arm: ArmData, q: SX) -> SX:
    """Return the geometric Jacobian (6, n) at the tool point in the world frame."""
    geometry = kinematic_chain(arm, q)
    return chain_jacobian(arm, geometry, geometry.position)


def tool_jacobian(arm: ArmData, q: SX) -> SX:
    """Return the geometric Jacobian (6, n) at the tool point, rows in the tool frame."""
    geometry = kinematic_chain(arm, q, frame=arm.n)  # the frame of the last link, in which the tool is fixed
    link_jacobian = chain_jacobian(arm, geometry, geometry.position)
    return ca.vertcat(geometry.rotation.T @ link_jacobian[:3, :], geometry.rotation.T @ link_jacobian[3:, :])


def invariant_jacobian(arm: ArmData, q: SX) -> SX:
    """Return a Jacobian ``A(q) J(q)`` with ``det A = 1`` and the fewest non-zero entries, for indices that do not depend on A.

    It is the geometric Jacobian in the frame of a link in the middle of the arm, for the point of the tool at that frame's
    origin. For the 9-joint PA10 this takes 774 operations, and the world frame 1189.
    """
    best: SX = None
    steps = joint_transforms(arm, q)
    for frame in range(arm.n + 1):
        geometry = kinematic_chain(arm, q, frame, steps)
        candidate = ca.sparsify(chain_jacobian(arm, geometry, ca.SX(3, 1)))
        cost = (candidate.nnz(), ca.Function("cost", [q], [candidate], {"allow_free": True}).n_instructions())
        if best is None or cost < best[0]:
            best = cost, candidate
    return best[1]


def jacobian_derivative(arm: ArmData, q: SX) -> SX:
    """Return ``d J / d q_j`` stacked, (6 n, n): rows 6 j to 6 j + 5 contain the derivative by joint j."""
    world_frame_jacobian = world_jacobian(arm, q)
    return ca.vertcat(
        *[ca.reshape(ca.jacobian(ca.vec(ca.densify(world_frame_jacobian)), q[i]), 6, arm.n) for i in range(arm.n)]
    )


def identity_matrix() -> SX:
    """Return the sparse identity (3, 3)."""
    return ca.SX(ca.Sparsity.diag(3), 1)


def constant_matrix(a: FloatArray) -> SX:
    """Return a matrix of numbers as a sparse symbolic matrix."""
    return ca.sparsify(ca.SX(ca.DM(a)))


def split_transform(transform: FloatArray | SX) -> Frame:
    """Return rotation (3, 3) and position (3,) of a transform (4, 4), in numbers or in symbols."""
    if isinstance(transform, ca.SX):
        return transform[:3, :3], transform[:3, 3]
    return constant_matrix(transform[:3, :3]), constant_matrix(transform[:3, 3])


def is_limit_given(limit: float | SX) -> bool:
    """Return True if a limit is given: a finite number, or a symbol."""
    return isinstance(limit, ca.SX) or bool(np.isfinite(limit))


def compose_frames(a: Frame, b: Frame) -> Frame:
    """Return the transform a followed by b, as a matrix product."""
    return a[0] @ b[0], a[1] + a[0] @ b[1]


def _invert_frame(a: Frame) -> Frame:
    return a[0].T, -(a[0].T @ a[1])


def joint_transforms(arm: ArmData, q: SX) -> list[Frame]:
    """Return the motion of every joint: rotation (3, 3) and translation (3,)."""
    return [_joint_motion(arm, k, q) for k in range(arm.n)]


def _joint_motion(arm: ArmData, index: int, q: SX) -> Frame:
    joint = arm.joints[index]
    axis = joint.axis
    if joint.prismatic:
        return identity_matrix(), constant_matrix(axis) * q[index]
    cosine, sine = ca.cos(q[index]), ca.sin(q[index])
    outer, skew = np.outer(axis, axis), np.cross(np.eye(3), axis)
    # Rodrigues; for an axis along x, y or z the products below vanish and a plane rotation remains.
    return constant_matrix(outer) + constant_matrix(np.eye(3) - outer) * cosine + constant_matrix(skew) * sine, ca.SX(3, 1)
