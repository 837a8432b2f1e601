"""Manifold of configurations that meet all path constraints: margins, proved straight segments, extensions, and projection.

Each :class:`ToolConstraint` bounds the lengths of two error vectors ``v`` of the tool's pose: the position across its line or
plane, and for the orientation either the part of the tool's axis across its direction (of length sine of their angle), or the
difference of both rotation matrices (of length ``2 sqrt(2) sin(angle / 2)``). Along a straight segment of joint space, passed
in time 1, no length exceeds the longer end's plus ``|v''| / 8``, because a straight line between the ends is convex. With ``d``
the joints' motion, ``|v''|`` is at most ``sum_kl r_max(k,l) |d_k| |d_l|`` for the position, with ``r_l`` the largest distance
of the tool from axis l, because ``d2p / dq_k dq_l = z_k x (z_l x r_l)`` for ``k <= l`` (zero for a prismatic joint k, and
without ``r_l`` for a prismatic joint l). It is at most ``(sum |d_k|)^2`` for a tool axis, and ``sqrt(2)`` times that for the
matrix.

The file ``constraint_manifold.hpp`` contains the compiled code.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from ctypes import Structure, byref, c_double, c_int64, c_void_p

import numpy as np

from holdfast.core.caching import cached_property
from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.model.arm.configurations import align_joint_frames, bound_axis_distances
from holdfast.model.arm.model import Arm
from holdfast.model.collision.compiled.edges import EdgeChecker
from holdfast.model.collision.compiled.library import list_fields, load_library
from holdfast.model.collision.compiled.scene import tabulate_joints

ExtraEquations = Callable[[FloatArray, IndexArray], tuple[FloatArray, FloatArray]]
"""Errors (N, k) and slopes (N, k, n) of further equations, for configurations (N, n) and the numbers of their rows."""

_ROUNDING_M_RAD = 1e-9  # m and rad
_EQUALITY_TOLERANCE = 1e-8  # m and rad: error below which an exact row is met
_PROJECTION_STEPS = 12  # steps
_MAX_NEWTON_STEP = 0.3  # rad or m of one joint in one step
_PARALLEL_TOLERANCE = 1e-10  # largest sine of the angle of two axes that count as parallel
_MAX_EXTENSION_STEPS = 400  # largest number of steps of one extension
# As in constraint_manifold.hpp.
_MAX_JOINTS = 64
_MAX_EQUATIONS = 24
_CONE_FRACTION = 0.9
_CONSTRAINT_TYPE = np.dtype(
    [(name, np.int64) for name in ("normal_count", "is_turned", "has_axis")]
    + [(name, np.float64, size) for name, size in {"normals": 9, "anchor": 3, "rotation": 9, "direction": 3, "axis": 3}.items()]
    + [("angle", np.float64)]
)


class _Manifold(Structure):
    """Structure ``Manifold`` of constraint_manifold.hpp."""

    _fields_ = (
        *list_fields(c_int64, "joint_count constraint_count length_count"),
        *list_fields(c_void_p, "joints constraints tool bounds slacks low high is_revolute lever_arms second_derivatives"),
    )


class _Extensions(Structure):
    """Structure ``Extensions`` of constraint_manifold.hpp."""

    _fields_ = (
        *list_fields(c_void_p, "starts targets scale"),
        *list_fields(c_int64, "has_largest_joint_metric count max_steps"),
        ("resolution", c_double),
        *list_fields(c_void_p, "zeros points point_counts has_arrived"),
    )


class ConstraintManifold:
    """Configurations that meet the path constraints, for an arm with locked joints and limits.

    Args:
        arm: Arm model with the limits in force.
        keep: Constraints through the pose at the start; see :meth:`ToolConstraint.anchor`.
        free: (n,) True for joints that move.
        limits: (n,) lower and (n,) upper limits of the joints, rad and m; equal for joints that do not move.

    Attributes:
        has_equalities: True if some row is exact, so that no straight segment of joint space meets it for long.

    Raises:
        InputError: There are too many joints or constraints.
    """

    def __init__(
        self, arm: Arm, keep: Sequence[ToolConstraint], free: BoolArray, limits: tuple[FloatArray, FloatArray]
    ) -> None:
        self.arm, self.keep, self.free = arm, tuple(keep), free
        self._low, self._high = limits
        tool_length, extensions = float(np.linalg.norm(arm.tool[:3, 3])), np.maximum(*np.abs(limits)).tolist()
        self._revolute = (~arm.prismatic).astype(np.float64)
        self._lever_arms = np.where(arm.prismatic, 1.0, bound_axis_distances(arm, tool_length, extensions))
        larger, smaller = (outer(np.arange(arm.n), np.arange(arm.n)) for outer in (np.maximum.outer, np.minimum.outer))
        bounds, is_equality, self._row_count = list[float](), list[bool](), 0
        for constraint in self.keep:
            if len(constraint.normals):
                bounds.append(constraint.within[0])
                is_equality.append(True)
                self._row_count += len(constraint.normals)
            if constraint.turned or constraint.direction is not None:
                angle = constraint.widest
                bounds.append(2 * np.sqrt(2) * np.sin(angle / 2) if constraint.turned else np.sin(angle))
                is_equality.append(constraint.turned or constraint.angle == 0)
                self._row_count += 3 if is_equality[-1] else 1
        if arm.n > _MAX_JOINTS or self._row_count > _MAX_EQUATIONS:
            raise InputError(
                f"'{arm.name}' has {arm.n} joints, and the tool constraints have {self._row_count} equations; at most "
                f"{_MAX_JOINTS} joints and {_MAX_EQUATIONS} equations are possible"
            )
        self.has_equalities, self._bounds = any(is_equality), np.array(bounds)
        tool = align_joint_frames(arm)[1][-1] @ arm.tool
        slacks = np.where(is_equality, 1.0, 1 - _CONE_FRACTION) * self._bounds
        numbers = [tabulate_joints(arm), np.append(tool[:3, :3], tool[:3, 3]), self._bounds, slacks, *limits, self._revolute]
        numbers += [self._lever_arms, self._lever_arms[larger] * self._revolute[smaller]]
        joints, *others = [np.ascontiguousarray(values, dtype=np.float64) for values in numbers]
        self._library, self._arrays = load_library(), (joints, _tabulate_constraints(self.keep, tool[:3, :3]), *others)
        counts = arm.n, len(self.keep), len(bounds)
        self._manifold = _Manifold(*counts, *(array.ctypes.data for array in self._arrays))

    @cached_property
    def changing_joints(self) -> BoolArray:
        """(n,) True for joints that move, without the first and the last of them if no error depends on them.

        A joint about a vertical axis at the base, or about the tool's axis at the end, does not change the tilt of the tool.
        """
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

    def evaluate_errors(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the lengths (N, R) of the errors at q (N, n), their rows (N, k), 0 if met, and their slopes (N, k, n).

        The slopes of a row state how the motion of the joints reduces its error.
        """
        q = np.ascontiguousarray(q)
        lengths, rows = np.empty((len(q), len(self._bounds))), np.empty((len(q), self._row_count))
        slopes = np.empty((*rows.shape, self.arm.n))
        outputs = (array.ctypes.data for array in (lengths, rows, slopes))
        self._library.evaluate_errors(byref(self._manifold), q.ctypes.data, len(q), *outputs)
        return lengths, rows, slopes

    def constraint_margins(self, q: FloatArray) -> FloatArray:
        """Return the margins (N, R) of the constraints at q (N, n), m and about rad; below 0 if one is violated."""
        return np.asarray(self._bounds + _ROUNDING_M_RAD - self.evaluate_errors(q)[0])

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

    def exclude_boxes(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        """Return (N,) True where a constraint is violated at every configuration within ``half_widths`` (n,) of q (N, n)."""
        inputs = np.ascontiguousarray(q), np.where(self.changing_joints, half_widths, 0.0)
        is_excluded = np.zeros(len(q), dtype=np.bool_)
        self._library.exclude_boxes(
            byref(self._manifold), *(array.ctypes.data for array in inputs), len(q), is_excluded.ctypes.data
        )
        return is_excluded

    # ---- motions -----------------------------------------------------------------------------------------------------

    def prove_edges(self, a: FloatArray, b: FloatArray, deviation: FloatArray | None = None) -> BoolArray:
        """Return (E,) True where all constraints are proved to hold on the whole straight segment from a to b (E, n).

        With ``deviation`` (E, n) this includes configurations whose joints deviate from the segment by no more.
        """
        reserves = self.bound_changes(np.zeros_like(a) if deviation is None else deviation)
        inputs = [np.ascontiguousarray(values) for values in (a, b - a, reserves)]
        is_proved = np.zeros(len(a), dtype=np.bool_)
        self._library.prove_constraints(
            byref(self._manifold), *(array.ctypes.data for array in inputs), len(a), is_proved.ctypes.data
        )
        return is_proved

    def extend_paths(
        self,
        starts: FloatArray,
        targets: FloatArray,
        scale: FloatArray,
        *,
        has_largest_joint_metric: bool,
        edges: EdgeChecker | None,
        resolution: float,
    ) -> tuple[list[FloatArray], BoolArray]:
        """Extend paths along the constraints, and return the points (k, n) after each start, and which paths arrive.

        Args:
            starts: (N, n) valid configurations.
            targets: (N, n) ends to which the paths come as near as possible.
            scale: (n,) scale of each joint in lengths.
            has_largest_joint_metric: Length is the largest scaled motion of a joint, instead of the Euclidean norm.
            edges: Proofs that steps are collision-free; None: no check.
            resolution: Change of distances, m, below which a piece that is not proved counts as blocked.
        """
        count, inputs = len(starts), [np.ascontiguousarray(values) for values in (starts, targets, scale)]
        points, zeros = np.empty((count, _MAX_EXTENSION_STEPS, self.arm.n)), np.zeros(_MAX_JOINTS)
        point_counts, has_arrived = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=np.bool_)
        numbers = has_largest_joint_metric, count, _MAX_EXTENSION_STEPS, resolution
        arrays = [[array.ctypes.data for array in group] for group in (inputs, (zeros, points, point_counts, has_arrived))]
        scene = None if edges is None else edges.double.address
        self._library.extend_paths(byref(self._manifold), scene, byref(_Extensions(*arrays[0], *numbers, *arrays[1])))
        return [path[:size].copy() for path, size in zip(points, point_counts, strict=True)], has_arrived

    # ---- projection --------------------------------------------------------------------------------------------------

    def project(self, q: FloatArray, extra_equations: ExtraEquations | None = None) -> FloatArray:
        """Project configurations q (N, n) onto the constraints within the limits by Newton's method; it may fail for some.

        Args:
            q: (N, n) configurations, rad and m; rows that meet everything exactly are unchanged.
            extra_equations: Errors and slopes of rows that must be met in addition; None: there are none.
        """
        q = q.copy()
        moving = np.arange(len(q))
        for _ in range(_PROJECTION_STEPS):
            _, errors, jacobians = self.evaluate_errors(q[moving])
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


def _tabulate_constraints(keep: Sequence[ToolConstraint], tool_rotation: FloatArray) -> np.ndarray:
    """Return structures ``Constraint`` of constraint_manifold.hpp, with the tool's axis in the frame of the last link."""
    table = np.zeros(len(keep), dtype=_CONSTRAINT_TYPE)
    for row, constraint in zip(table, keep, strict=True):
        assert constraint.pose is not None, "not anchored"
        row["normal_count"], row["is_turned"], row["angle"] = len(constraint.normals), constraint.turned, constraint.angle
        row["normals"][: constraint.normals.size], row["anchor"] = constraint.normals.ravel(), constraint.pose[:3, 3]
        row["rotation"], row["axis"] = constraint.pose[:3, :3].ravel(), tool_rotation @ constraint.axis
        if constraint.direction is not None:
            row["direction"], row["has_axis"] = constraint.direction, True
    return table
