"""Manifold of configurations that meet all path constraints: margins, proved straight segments, and projection.

Each :class:`ToolConstraint` bounds the lengths of two error vectors ``v`` of the tool's pose: the position across its line or
plane, and for the orientation either the part of the tool's axis across its direction (of length sine of their angle), or the
difference of both rotation matrices (of length ``2 sqrt(2) sin(angle / 2)``). Along a straight segment of joint space, passed
in time 1, no length exceeds the longer end's plus ``|v''| / 8``, because a straight line between the ends is convex. With ``d``
the joints' motion, ``|v''|`` is at most ``sum_kl r_max(k,l) |d_k| |d_l|`` for the position, with ``r_l`` the largest distance
of the tool from axis l, because ``d2p / dq_k dq_l = z_k x (z_l x r_l)`` for ``k <= l`` (zero for a prismatic joint k, and
without ``r_l`` for a prismatic joint l). It is at most ``(sum |d_k|)^2`` for a tool axis, and ``sqrt(2)`` times that for the
matrix.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.tool_constraints.compiled_manifold import CompiledManifold
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.model.arm.configurations import bound_axis_distances
from holdfast.model.arm.model import Arm

More = Callable[[FloatArray, IndexArray], tuple[FloatArray, FloatArray]]
"""Errors (N, k) and slopes (N, k, n) of further equations, for configurations (N, n) and the numbers of their rows."""

_ROUNDING_M_RAD = 1e-9  # m and rad
_EQUALITY_TOLERANCE = 1e-8  # m and rad: error below which an exact row is met
_CONE_FRACTION = 0.9  # of a cone's opening: axes outside are projected to there, which leaves a margin for the next segment
_PROJECTION_STEPS = 12  # steps
_MAX_NEWTON_STEP = 0.3  # rad or m of one joint in one step
_PARALLEL_TOLERANCE = 1e-10  # largest sine of the angle of two axes that count as parallel


class ConstraintManifold:
    """Configurations that meet the path constraints, for an arm with locked joints and limits.

    Args:
        arm: Arm model with the limits in force.
        keep: Constraints through the pose at the start; see :meth:`ToolConstraint.anchor`.
        free: (n,) True for joints that move.
        limits: (n,) lower and (n,) upper limits of the joints, rad and m; equal for a locked prismatic joint.

    Attributes:
        has_equalities: True if some row is exact, so that no straight segment of joint space meets it for long.
        compiled: Compiled proofs and extensions.
        changing_joints: (n,) True for moving joints that change an error. A joint about a vertical axis at the base, or about
            the tool's axis at the end, does not change the tilt of the tool.
    """

    def __init__(
        self, arm: Arm, keep: Sequence[ToolConstraint], free: BoolArray, limits: tuple[FloatArray, FloatArray]
    ) -> None:
        self.arm, self.keep, self.free = arm, tuple(keep), free
        self._low, self._high = limits
        tool_length, extensions = float(np.linalg.norm(arm.tool[:3, 3])), np.maximum(*np.abs(limits)).tolist()
        joint_index = np.arange(arm.n)
        lever_arms = np.where(arm.prismatic, 1.0, bound_axis_distances(arm, tool_length, extensions))
        self._revolute = (~arm.prismatic).astype(np.float64)
        self._lever_arms = lever_arms
        larger, smaller = (outer(joint_index, joint_index) for outer in (np.maximum.outer, np.minimum.outer))
        second_derivatives = lever_arms[larger] * self._revolute[smaller]
        bounds, is_equality = [], []
        for constraint in self.keep:
            if len(constraint.normals):
                bounds.append(constraint.within[0])
                is_equality.append(True)
            if constraint.turned:
                bounds.append(2 * np.sqrt(2) * np.sin(constraint.widest / 2))
                is_equality.append(True)
            elif constraint.direction is not None:
                bounds.append(np.sin(constraint.widest))
                is_equality.append(constraint.angle == 0)
        self._bounds = np.array(bounds)
        self.has_equalities = any(is_equality)
        slacks = np.where(is_equality, 1.0, 1 - _CONE_FRACTION) * self._bounds
        self.compiled = CompiledManifold(arm, self.keep, self._bounds, slacks, limits, lever_arms, second_derivatives)
        self.changing_joints = self._find_changing_joints()

    def _find_changing_joints(self) -> BoolArray:
        """Return (n,) False for locked joints, and for the first and last moving joint if no error depends on them."""
        changing, moving, q = self.free.copy(), np.flatnonzero(self.free), self._low[None].copy()
        q[~np.isfinite(q)] = 0.0
        if not moving.size or any(constraint.turned or len(constraint.normals) for constraint in self.keep):
            return changing
        joint_axes, rotation = self.arm.jacobian(q)[0, 3:].T, self.arm.forward_kinematics(q)[0, :3, :3]
        first_axes, last_axes = ([getattr(constraint, name) for constraint in self.keep] for name in ("direction", "axis"))
        for joint, axes in ((moving[0], first_axes), (moving[-1], last_axes @ rotation.T)):
            changing[joint] = np.abs(np.cross(joint_axes[joint], axes)).max() > _PARALLEL_TOLERANCE
        return changing

    # ---- margins -----------------------------------------------------------------------------------------------------

    def constraint_margins(self, q: FloatArray) -> FloatArray:
        """Return the margins (N, R) of the constraints at q (N, n), m and about rad; below 0 if one is violated."""
        return np.asarray(self._bounds + _ROUNDING_M_RAD - self.compiled.evaluate_errors(q)[0])

    def is_satisfied(self, q: FloatArray) -> BoolArray:
        """Return (N,) True where all constraints are met at q (N, n)."""
        return np.asarray((self.constraint_margins(q) >= 0).all(axis=1))

    def bound_changes(self, d: FloatArray) -> FloatArray:
        """Bound the change (N, R) of the error vectors if joints move by d (N, n)."""
        joint_travel, bounds = np.abs(d), []
        for constraint in self.keep:
            if len(constraint.normals):
                bounds.append(joint_travel @ self._lever_arms)
            if constraint.turned or constraint.direction is not None:
                bounds.append((np.sqrt(2) if constraint.turned else 1.0) * (joint_travel @ self._revolute))
        return np.stack(bounds, axis=1)

    def are_boxes_violated(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        """Return (N,) True where a constraint is violated at every configuration within ``half_widths`` (n,) of q (N, n)."""
        return self.compiled.exclude_boxes(q, np.where(self.changing_joints, half_widths, 0.0))

    def prove_edges(self, a: FloatArray, b: FloatArray, deviation: FloatArray | None = None) -> BoolArray:
        """Return (E,) True where all constraints are proved to hold on the whole straight segment from a to b (E, n).

        With ``deviation`` (E, n) this includes configurations whose joints deviate from the segment by no more.
        """
        return self.compiled.prove_edges(a, b - a, self.bound_changes(np.zeros_like(a) if deviation is None else deviation))

    # ---- projection --------------------------------------------------------------------------------------------------

    def project(self, q: FloatArray, extra_equations: More | None = None) -> FloatArray:
        """Project configurations q (N, n) onto the constraints within the limits by Newton's method; it may fail for some.

        Args:
            q: (N, n) configurations, rad and m; rows that meet everything exactly are unchanged.
            extra_equations: Errors and slopes of rows that must be met in addition; None: there are none.
        """
        q = q.copy()
        moving = np.arange(len(q))
        for _ in range(_PROJECTION_STEPS):
            _, errors, jacobians = self.compiled.evaluate_errors(q[moving])
            if extra_equations is not None:
                extra_terms = extra_equations(q[moving], moving)
                errors = np.concatenate([errors, extra_terms[0]], axis=1)
                jacobians = np.concatenate([jacobians, extra_terms[1]], axis=1)
            unmet = np.abs(errors).max(axis=1) > _EQUALITY_TOLERANCE
            moving, errors, jacobians = moving[unmet], errors[unmet], jacobians[unmet]
            if not moving.size:
                break
            q[moving] = self._newton_step(q[moving], errors, jacobians)
        return q

    def _newton_step(self, q: FloatArray, errors: FloatArray, jacobians: FloatArray) -> FloatArray:
        """Take one step of least length; joints that it would push beyond their limits do not move."""
        movable: BoolArray = np.broadcast_to(self.free, q.shape)
        for _ in range(2):
            masked = jacobians * movable[:, None, :]
            gram = masked @ masked.transpose(0, 2, 1)
            gram += (1e-10 * np.trace(gram, axis1=1, axis2=2) + 1e-14)[:, None, None] * np.eye(gram.shape[1])
            step = (masked.transpose(0, 2, 1) @ np.linalg.solve(gram, errors[:, :, None]))[:, :, 0]
            beyond_limits = ((q <= self._low) & (step < 0)) | ((q >= self._high) & (step > 0))
            if not (beyond_limits & movable).any():
                break
            movable = movable & ~beyond_limits
        step *= np.minimum(1.0, _MAX_NEWTON_STEP / np.maximum(np.abs(step).max(axis=1), 1e-12))[:, None]
        return np.asarray(np.where(movable, np.clip(q + step, self._low, self._high), q))
