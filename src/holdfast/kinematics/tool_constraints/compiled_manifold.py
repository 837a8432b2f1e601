"""Compiled proofs of edges, and extensions of paths, along tool constraints; see ``constraint_manifold.hpp``."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import Structure, addressof, byref, c_double, c_int64, c_void_p

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.kinematics.tool_constraints.constraint import ToolConstraint
from holdfast.model.arm.configurations import align_joint_frames
from holdfast.model.arm.model import Arm
from holdfast.model.collision.compiled.edges import EdgeChecker
from holdfast.model.collision.compiled.library import list_fields, load_library
from holdfast.model.collision.compiled.scene import tabulate_joints

# As in constraint_manifold.hpp.
_MAX_JOINTS = 64
_MAX_ROWS = 24
_MAX_STEPS = 400  # largest number of steps of one extension


class _Constraint(Structure):
    """Structure ``Constraint`` of constraint_manifold.hpp."""

    _fields_ = (
        *list_fields(c_int64, "normal_count is_turned has_axis"),
        *list_fields(c_double * 9, "normals"),
        *list_fields(c_double * 3, "anchor"),
        *list_fields(c_double * 9, "rotation"),
        *list_fields(c_double * 3, "direction axis"),
        ("angle", c_double),
    )


class _Manifold(Structure):
    """Structure ``Manifold``."""

    _fields_ = (
        *list_fields(c_int64, "joint_count constraint_count length_count has_largest_joint_metric"),
        *list_fields(
            c_void_p, "joints constraints tool bounds slacks low high is_revolute lever_arms second_derivatives scale"
        ),
    )


class _Extensions(Structure):
    """Structure ``Extensions``."""

    _fields_ = (
        *list_fields(c_void_p, "starts targets may_arrive"),
        *list_fields(c_int64, "count max_steps"),
        ("resolution", c_double),
        *list_fields(c_void_p, "zeros points point_counts has_arrived"),
    )


class CompiledManifold:
    """Tool constraints of an arm as tables for compiled code.

    Args:
        arm: Arm model.
        keep: Anchored constraints.
        bounds, slacks: (R,) largest lengths of the errors, and the part of them that one step may use.
        limits: (n,) lower and (n,) upper limits of the joints, rad and m; equal for joints that do not move.
        lever_arms: (n,) largest motion of the tool per unit of each joint.
        second_derivatives: (n, n) bounds of the second derivatives of the tool's position.

    Raises:
        InputError: There are too many joints or constraints.
    """

    def __init__(
        self,
        arm: Arm,
        keep: Sequence[ToolConstraint],
        bounds: FloatArray,
        slacks: FloatArray,
        limits: tuple[FloatArray, FloatArray],
        lever_arms: FloatArray,
        second_derivatives: FloatArray,
    ) -> None:
        self._row_count = row_count = sum(map(_count_rows, keep))
        if arm.n > _MAX_JOINTS or row_count > _MAX_ROWS:
            raise InputError(
                f"'{arm.name}' has {arm.n} joints, and the tool constraints have {row_count} rows; at most {_MAX_JOINTS} "
                f"joints and {_MAX_ROWS} rows are possible"
            )
        _, link_poses = align_joint_frames(arm)
        tool = link_poses[-1] @ arm.tool
        self._library, self._n = load_library(), arm.n
        self._constraints = (_Constraint * len(keep))(*(_tabulate_constraint(constraint, tool[:3, :3]) for constraint in keep))
        arrays = [tabulate_joints(arm), np.append(tool[:3, :3], tool[:3, 3]), bounds, slacks, *limits, ~arm.prismatic]
        arrays += [lever_arms, second_derivatives, np.ones(arm.n)]
        self._arrays = [np.ascontiguousarray(array, dtype=np.float64) for array in arrays]
        joints, *others = (array.ctypes.data for array in self._arrays)
        counts = arm.n, len(keep), len(bounds), False
        self._manifold = _Manifold(*counts, joints, addressof(self._constraints), *others)

    def evaluate_errors(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the lengths (N, R) of the errors at q (N, n), their rows (N, k), 0 if met, and their slopes (N, k, n).

        The slopes of a row state how the motion of the joints reduces its error.
        """
        q = np.ascontiguousarray(q)
        lengths, rows = np.empty((len(q), self._manifold.length_count)), np.empty((len(q), self._row_count))
        slopes = np.empty((*rows.shape, self._n))
        outputs = (array.ctypes.data for array in (lengths, rows, slopes))
        self._library.evaluate_errors(addressof(self._manifold), q.ctypes.data, len(q), *outputs)
        return lengths, rows, slopes

    def exclude_boxes(self, q: FloatArray, half_widths: FloatArray) -> BoolArray:
        """Return (N,) True where a constraint is violated at every configuration within ``half_widths`` (n,) of q (N, n)."""
        arrays, is_excluded = [np.ascontiguousarray(values) for values in (q, half_widths)], np.zeros(len(q), dtype=np.bool_)
        addresses = (array.ctypes.data for array in arrays)
        self._library.exclude_boxes(addressof(self._manifold), *addresses, len(q), is_excluded.ctypes.data)
        return is_excluded

    def prove_edges(self, starts: FloatArray, differences: FloatArray, reserves: FloatArray) -> BoolArray:
        """Return (E,) True where all constraints are proved to hold on straight edges.

        Args:
            starts: (E, n) first configurations.
            differences: (E, n) last minus first configurations.
            reserves: (E, R) part of the bounds that must be left.
        """
        arrays = [np.ascontiguousarray(values) for values in (starts, differences, reserves)]
        is_proved = np.zeros(len(starts), dtype=np.bool_)
        addresses = (array.ctypes.data for array in arrays)
        self._library.prove_constraints(addressof(self._manifold), *addresses, len(starts), is_proved.ctypes.data)
        return is_proved

    def extend_paths(
        self,
        starts: FloatArray,
        targets: FloatArray,
        may_arrive: BoolArray,
        *,
        scale: FloatArray,
        has_largest_joint_metric: bool,
        edges: EdgeChecker | None,
        resolution: float,
    ) -> tuple[list[FloatArray], BoolArray]:
        """Extend paths along the constraints, and return the points (k, n) after each start, and which paths arrive.

        Args:
            starts: (N, n) valid configurations.
            targets: (N, n) ends to which the paths come as near as possible.
            may_arrive: (N,) True for targets that are valid.
            scale: (n,) scale of each joint in lengths.
            has_largest_joint_metric: Length is the largest scaled motion of a joint, instead of the Euclidean norm.
            edges: Proofs that steps are collision-free; None: no check.
            resolution: Change of distances, m, below which a piece that is not proved counts as blocked.
        """
        self._arrays[-1][:] = scale
        self._manifold.has_largest_joint_metric = has_largest_joint_metric
        arrays = [np.ascontiguousarray(starts), np.ascontiguousarray(targets), np.ascontiguousarray(may_arrive)]
        points, zeros = np.empty((len(starts), _MAX_STEPS, self._n)), np.zeros(_MAX_JOINTS)
        counts, has_arrived = np.zeros(len(starts), dtype=np.int64), np.zeros(len(starts), dtype=np.bool_)
        outputs = (array.ctypes.data for array in (zeros, points, counts, has_arrived))
        extensions = _Extensions(*(array.ctypes.data for array in arrays), len(starts), _MAX_STEPS, resolution, *outputs)
        scene = None if edges is None else edges.double.address
        self._library.extend_paths(addressof(self._manifold), scene, byref(extensions))
        return [path[:count].copy() for path, count in zip(points, counts, strict=True)], has_arrived


def _count_rows(constraint: ToolConstraint) -> int:
    is_cone = constraint.angle > 0 and not constraint.turned
    return len(constraint.normals) + (0 if constraint.widest == np.inf else 1 if is_cone else 3)


def _tabulate_constraint(constraint: ToolConstraint, tool_rotation: FloatArray) -> _Constraint:
    assert constraint.pose is not None, "not anchored"
    table = _Constraint(
        normal_count=len(constraint.normals),
        is_turned=constraint.turned,
        has_axis=constraint.direction is not None and not constraint.turned,
        angle=constraint.angle,
    )
    vectors = {
        "normals": constraint.normals,
        "anchor": constraint.pose[:3, 3],
        "rotation": constraint.pose[:3, :3],
        "axis": tool_rotation @ constraint.axis,
        "direction": np.zeros(3) if constraint.direction is None else constraint.direction,
    }
    for name, values in vectors.items():
        getattr(table, name)[: values.size] = values.ravel().tolist()
    return table
