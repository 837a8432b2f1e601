"""Symbolic kinematics of a serial arm: the equations, written once.

Everything here takes and returns CasADi ``SX``; the fixed geometry enters as exact numbers, so terms that vanish for
an arm vanish from its code. Where the geometry itself is to vary (:mod:`holdfast.design`), symbols stand in its place.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.arm.machine import Machine
from holdfast.kernels.program import SX

Array = NDArray[np.float64]
Frame = tuple[SX, SX]


@dataclass(frozen=True)
class Chain:
    """Joint axes and tool of an arm in one common frame, as functions of q.

    Attributes:
        axes: n columns (3,), direction of each joint axis.
        points: n columns (3,), a point on each axis, m.
        rotation: (3, 3) orientation of the tool.
        position: (3,) tool point, m.
    """

    axes: list[SX]
    points: list[SX]
    rotation: SX
    position: SX


def joint_symbols(arm: Machine) -> SX:
    """Symbols of the joint variables, (n,)."""
    return ca.SX.sym("q", arm.n)


def chain(arm: Machine, q: SX, frame: int | None = None, steps: list[Frame] | None = None) -> Chain:
    """Where the joint axes are.

    Args:
        arm: The arm.
        q: (n,) joint variables.
        frame: None: the world. k from 0 to n: the frame that moves with joint k - 1 (0: the arm's base), in which the
            axes near joint k are simple. The choice does not change what any invariant index is, only how long its
            code gets.
        steps: :func:`joint_steps` of the same q, where several chains are made.
    """
    moving, still = frames(arm, joint_steps(arm, q) if steps is None else steps, frame)
    axes = [_column(rotation, joint.axis) for (rotation, _), joint in zip(still, arm.joints, strict=True)]
    return Chain(axes, [position for _, position in still], *compose(moving[-1], split(arm.tool)))


def frames(arm: Machine, steps: list[Frame], frame: int | None = None) -> tuple[list[Frame], list[Frame]]:
    """Where the bodies and the joints are: rotation (3, 3) and origin (3,) of each.

    Args:
        arm: The arm.
        steps: :func:`joint_steps`.
        frame: The frame in which they are given; see :func:`chain`.

    Returns:
        The n + 1 frames of the base and of what moves with each joint; the n joint frames, which their own joint leaves
        where they are.
    """
    n, start = arm.n, 0 if frame is None else frame
    moving: dict[int, Frame] = {start: split(arm.base) if frame is None else (eye(), ca.SX(3, 1))}
    still: dict[int, Frame] = {}
    for k in range(start, n):
        still[k] = compose(moving[k], split(arm.joints[k].origin))
        moving[k + 1] = compose(still[k], steps[k])
    for k in reversed(range(start)):
        still[k] = compose(moving[k + 1], _inverse(steps[k]))
        moving[k] = compose(still[k], _inverse(split(arm.joints[k].origin)))
    return [moving[k] for k in range(n + 1)], [still[k] for k in range(n)]


def body_poses(arm: Machine, q: SX) -> SX:
    """Poses in the world, each (3, 4), of the base, of what moves with each joint and of the tool, (3 (n + 2), 4)."""
    moving, _ = frames(arm, joint_steps(arm, q))
    tool = compose(moving[-1], split(arm.tool))
    return ca.densify(ca.vertcat(*[ca.horzcat(*pose) for pose in [*moving, tool]]))


def tool_pose(arm: Machine, q: SX) -> SX:
    """Tool pose in the world, (4, 4)."""
    c = chain(arm, q)
    return ca.vertcat(ca.horzcat(c.rotation, c.position), ca.horzcat(ca.SX(1, 3), 1))


def jacobian_of(arm: Machine, c: Chain, reference: SX) -> SX:
    """Geometric Jacobian (6, n), rows (linear; angular) in the chain's frame, for the velocity of the point ``reference``.

    Source: column of a revolute joint ``(z x (p - p_k); z)``, of a prismatic one ``(z; 0)``.
    """
    columns = []
    for k, joint in enumerate(arm.joints):
        z = c.axes[k]
        if joint.prismatic:
            columns.append(ca.vertcat(z, ca.SX(3, 1)))
        else:
            columns.append(ca.vertcat(ca.cross(z, reference - c.points[k]), z))
    return ca.horzcat(*columns)


def jacobian(arm: Machine, q: SX) -> SX:
    """Geometric Jacobian (6, n) at the tool point in the world frame."""
    c = chain(arm, q)
    return jacobian_of(arm, c, c.position)


def tool_jacobian(arm: Machine, q: SX) -> SX:
    """Geometric Jacobian (6, n) at the tool point, rows in the tool frame."""
    c = chain(arm, q, frame=arm.n)  # the frame of the last link: the tool sits still in it
    j = jacobian_of(arm, c, c.position)
    return ca.vertcat(c.rotation.T @ j[:3, :], c.rotation.T @ j[3:, :])


def invariant_jacobian(arm: Machine, q: SX) -> SX:
    """A Jacobian ``A(q) J(q)`` with ``det A = 1`` and the fewest non-zero entries: for indices that are blind to A.

    It is the geometric Jacobian in the frame of a link in the middle of the arm, for the point of the tool that passes
    that frame's origin. For the 9-joint PA10 this takes 774 operations where the world frame takes 1189.
    """
    best: SX = None
    steps = joint_steps(arm, q)
    for frame in range(arm.n + 1):
        c = chain(arm, q, frame, steps)
        j = ca.sparsify(jacobian_of(arm, c, ca.SX(3, 1)))
        cost = (j.nnz(), ca.Function("cost", [q], [j], {"allow_free": True}).n_instructions())
        if best is None or cost < best[0]:
            best = cost, j
    return best[1]


def jacobian_derivative(arm: Machine, q: SX) -> SX:
    """``d J / d q_j`` stacked: rows 6 j to 6 j + 5 hold the derivative by joint j, (6 n, n)."""
    j = jacobian(arm, q)
    return ca.vertcat(*[ca.reshape(ca.jacobian(ca.vec(ca.densify(j)), q[i]), 6, arm.n) for i in range(arm.n)])


def eye() -> SX:
    """The identity (3, 3), zeros left out."""
    return ca.SX(ca.Sparsity.diag(3), 1)


def constant(a: Array) -> SX:
    """Numbers as a symbolic matrix, zeros left out."""
    return ca.sparsify(ca.SX(ca.DM(a)))


def split(transform: Array | SX) -> Frame:
    """Rotation (3, 3) and position (3,) of a constant transform (4, 4), in numbers or in symbols."""
    if isinstance(transform, ca.SX):
        return transform[:3, :3], transform[:3, 3]
    return constant(transform[:3, :3]), constant(transform[:3, 3])


def limited(limit: float | SX) -> bool:
    """True if there is a limit: a finite number, or a symbol."""
    return isinstance(limit, ca.SX) or bool(np.isfinite(limit))


def compose(a: Frame, b: Frame) -> Frame:
    """The transform a followed by b, as a matrix product."""
    return a[0] @ b[0], a[1] + a[0] @ b[1]


def _inverse(a: Frame) -> Frame:
    return a[0].T, -(a[0].T @ a[1])


def _column(rotation: SX, axis: Array) -> SX:
    return rotation @ constant(axis)


def joint_steps(arm: Machine, q: SX) -> list[Frame]:
    """The motion of every joint by itself: rotation (3, 3) and translation (3,)."""
    return [_joint_step(arm, k, q) for k in range(arm.n)]


def _joint_step(arm: Machine, k: int, q: SX) -> Frame:
    joint = arm.joints[k]
    axis = joint.axis
    if joint.prismatic:
        return eye(), constant(axis) * q[k]
    c, s = ca.cos(q[k]), ca.sin(q[k])
    outer, skew = np.outer(axis, axis), np.cross(np.eye(3), axis)
    # Rodrigues; for an axis along x, y or z the products below vanish and a plane rotation is left.
    return constant(outer) + constant(np.eye(3) - outer) * c + constant(skew) * s, ca.SX(3, 1)
