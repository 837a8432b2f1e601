"""Bounds over a box of joint values: one kernel for all boxes, poses and failures of an arm and a task.

Over a box with centre c and half widths h the rows of a task are ``e(q) = e(c) + J (q - c) + r`` with ``|r_i| <= b_i``. J is
exact, and b bounds the terms of second and higher order over the box. It is the smaller of a global bound of these terms, and
of their values at c, row by row, plus a bound of the third derivatives.

- ``rho_k``, a bound of the distance of the tool from axis k in the box, computed from the tool inwards, because only joints
  beyond k change it: ``min(rho_k of the arm, |J_k(c)| + sum_{l>k} rho_l h_l)``. For a prismatic joint it is 1, its column's
  norm.
- position: ``d2p / dq_k dq_l = z_k x (z_l x r_l)`` for ``k <= l``, and each further joint adds one product with its axis. So no
  derivative of order j with l outermost exceeds rho_l, and with ``A_l = sum_{k<=l} h_k`` their contribution is
  ``sum_l rho_l (A_l^j - A_{l-1}^j) / j!``; prismatic joints count only as the outermost, once.
- orientation: with the tool's axes ``a_i`` and the target axes ``d_i`` the rows are ``1/2 sum d_i x a_i``, or for the tool's z
  axis alone its products with the target x and y axes. Both are linear in the axes and each derivative is at most 1 in any
  direction, so terms of order j are at most ``S^j / j!`` with S the sum of the half widths of revolute joints. The second are
  ``1/2 (D A' z_k) x z_l - (z_k . z_l) e`` with the axes as columns of A and D. The rows also vanish at half a turn, which no
  box with ``S`` below the angle error can contain: such boxes are empty.

A box is empty if in some direction v of the rows ``|v e(c)| > sum_k |v J_k| h_k + sum_i |v_i| b_i + t |v|`` with the allowed
norm t of the errors, which differs for positions and orientations. Two directions are tried: the error's own, and
``v = (J h^2 J' + (b + t)^2)^-1 e(c)``, in which the error is largest relative to the extent of the box.

For every matrix Y the solutions in a box obey ``q - c = -Y e(c) + (I - Y J)(q - c) - Y r`` (Krawczyk 1969 in this form). The
right side is a box again, with ``Y = h^2 J' (J h^2 J' + (b + t)^2)^-1``, and the part outside of it is cut away. If as many
joints move as there are rows and the new box lies strictly inside, it contains a solution (Brouwer).

Source: interval Newton methods (Krawczyk 1969; Neumaier 1990); the bounds and the choice of Y and v are ours.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce

import casadi as ca
import numpy as np

from holdfast.core.errors import TaskError
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import Cholesky
from holdfast.kernels.program import SX
from holdfast.model.arm import kinematics
from holdfast.model.arm.configurations import bound_axis_distances
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, plane_normal

ROUNDING_M_RAD = 1e-9  # m and rad by which every bound is widened; the rounding errors of the kernel are 1e-13
_GRAM_REGULARIZATION = 1e-30  # keeps the inverse finite if a box and its remainder vanish
_ORIENTATION_WEIGHT_M = 0.35  # m: weight of 1 rad of a joint relative to tool travel in the choice of the joint to bisect
ORIENTATION_ROWS = {"none": 0, "axis": 2, "all": 3, "plane": 1}


@dataclass(frozen=True)
class BoundedTask:
    """Components of a pose that a task prescribes and for which bounds are available.

    Attributes:
        linear: (k, 3) rows of the position, world frame.
        orientation: ``none``, the tool's z ``axis``, ``all`` of the orientation, or the rotation in the ``plane`` of the arm.
        normal: (3,) normal vector of that plane.
    """

    linear: tuple[tuple[float, ...], ...]
    orientation: str
    normal: tuple[float, ...] = ()

    @property
    def m(self) -> int:
        """Number of prescribed components."""
        return len(self.linear) + ORIENTATION_ROWS[self.orientation]

    @classmethod
    def from_task(cls, arm: Arm, task: Task) -> BoundedTask:
        """Return the components of a task.

        Raises:
            TaskError: No bound is known for some rows.
        """
        rows = task.rows
        is_angular = np.abs(rows[:, 3:]).max(axis=1) > 0
        linear, angular = rows[~is_angular], rows[is_angular]
        is_mixed = bool(np.abs(angular[:, :3]).max(initial=0.0) > 0)
        if not is_mixed and (task.frame == "base" or len(linear) in (0, 3)):
            directions = np.eye(3) if task.frame == "tool" and len(linear) else linear[:, :3]
            linear_rows = tuple(map(tuple, directions.tolist()))
            normal = plane_normal(arm)
            if not len(angular):
                return cls(linear_rows, "none")
            if len(angular) == 3:
                return cls(linear_rows, "all")
            if task.frame == "tool" and len(angular) == 2 and np.abs(angular[:, 5]).max() == 0:
                return cls(linear_rows, "axis")
            if normal is not None and task.frame == "base" and abs(abs(angular[0, 3:] @ normal) - 1) < 1e-9:
                return cls(linear_rows, "plane", tuple(normal.tolist()))
        raise TaskError(
            f"nothing can be proved about task '{task.name}'; known are position rows in the world frame, alone, with the "
            "whole orientation, with the direction of the tool's z axis (pointing), or with the turn of a planar arm"
        )


@cached_kernel
def box_contraction_kernel(arm: Arm, parts: BoundedTask, is_along_leg: bool = False) -> Kernel:
    """Build the kernel of an arm and a task's components, for a pose or, if ``is_along_leg``, for a straight leg of a path.

    Inputs: centre (n,) and half widths (n,), rad and m; target position (3,) and orientation (3, 3); for each row (m,) the
    allowed norm of the errors of all position rows, m, or of all orientation rows, rad. Outputs: ``margin``, above 0 for an
    empty box; centre (n,) and half widths (n,) of the contracted box; ``inside``, below 0 if it lies strictly inside in the
    joints that move; its fraction of the volume; the joint to bisect; the vector from the old to the new centre (n,); the rows'
    error at the centre (m,).

    Along a leg the vector (3,), m, of the leg is one more input, and the position on it, 0 to 1, is one more joint: the last of
    the n joints.
    """
    n, size = arm.n, arm.n + is_along_leg
    centers, half_widths = ca.SX.sym("c", size), ca.SX.sym("h", size)
    target_position, target_rotation, tolerance = ca.SX.sym("p", 3), ca.SX.sym("r", 3, 3), ca.SX.sym("t", parts.m)
    leg_vector = ca.SX.sym("w", 3)
    chain = kinematics.kinematic_chain(arm, centers[:n])
    axis_point = _nearest_axis_point(arm) if parts.orientation == "all" and parts.linear else None
    offset = np.zeros(3) if axis_point is None else arm.tool[:3, :3].T @ (axis_point - arm.tool[:3, 3])
    point = chain.position + chain.rotation @ offset
    jacobian = kinematics.chain_jacobian(arm, chain, point)
    is_revolute = [not joint.prismatic for joint in arm.joints]
    rho = _axis_distance_bounds(
        arm, jacobian, (centers[:n], half_widths[:n]), is_revolute, arm.tool[:3, 3] if axis_point is None else axis_point
    )
    rotates_tool = is_orienting_joint(arm, parts)
    error, jacobian_rows, remainder = [], [], []
    if parts.linear:
        matrix = kinematics.constant_matrix(np.array(parts.linear))
        error.append(
            matrix @ (point - target_position - target_rotation @ offset - (centers[n] * leg_vector if is_along_leg else 0))
        )
        jacobian_rows.append(matrix @ ca.horzcat(jacobian[:3, :], *([-leg_vector] * is_along_leg)))
        second_order = _second_order_terms(
            lambda k, i: matrix @ ca.cross(jacobian[3:, k], jacobian[:3, i]), half_widths, is_revolute, [True] * n
        )
        remainder.append(_smaller_remainder(second_order, *_position_remainders(rho, half_widths, is_revolute)))
    cosine, total_rotation = None, sum((half_widths[k] for k in range(n) if rotates_tool[k]), ca.SX(0))
    if parts.orientation != "none":
        value, angular_jacobian, second_derivative, cosine = _orientation_terms(
            parts, chain.rotation, jacobian[3:, :], target_rotation
        )
        error.append(value)
        jacobian_rows.append(ca.horzcat(angular_jacobian, ca.SX(ORIENTATION_ROWS[parts.orientation], int(is_along_leg))))
        remainder.append(
            _smaller_remainder(
                _second_order_terms(second_derivative, half_widths, rotates_tool, rotates_tool),
                total_rotation**2 / 2,
                total_rotation**3 / 6,
            )
        )
    errors, task_jacobian = ca.densify(ca.vertcat(*error)), ca.vertcat(*jacobian_rows)
    rho += [ca.sqrt(ca.sumsqr(leg_vector))] * is_along_leg
    rotates_tool += [False] * is_along_leg
    linear_count, allowed_sine = len(parts.linear), ca.SX(0) if parts.orientation == "none" else tolerance[parts.m - 1]
    allowed_angle = ca.if_else(allowed_sine < 0.9, allowed_sine + allowed_sine**3, np.pi)
    allowed_norms = [allowed_sine] * parts.m
    if parts.linear:  # of a point off the tool
        point_distance = float(np.linalg.norm(offset) * np.linalg.norm(parts.linear, 2))
        allowed_norms[:linear_count] = [tolerance[0] + point_distance * allowed_angle] * linear_count

    def bound_errors(directions: SX) -> SX:
        """Return the largest change of the errors along the rows of a matrix (K, m), other than by the Jacobian."""
        bound = ca.fabs(directions) @ ca.vertcat(*remainder)
        for rows in filter(len, (range(linear_count), range(linear_count, parts.m))):
            bound += allowed_norms[rows[0]] * ca.sqrt(ca.sum2(directions[:, list(rows)] ** 2))
        return bound

    error_bounds = ca.vertcat(*remainder) + ca.vertcat(*allowed_norms)
    weighted = task_jacobian @ ca.diag(half_widths * half_widths)
    gram = weighted @ task_jacobian.T + ca.diag(error_bounds * error_bounds + _GRAM_REGULARIZATION)
    factor = Cholesky([[gram[i, k] for k in range(parts.m)] for i in range(parts.m)])
    direction = ca.vertcat(*factor.solve(ca.vertsplit(errors)))
    directions = [direction / ca.sqrt(ca.sumsqr(direction) + _GRAM_REGULARIZATION)]
    tests = []
    if parts.linear:
        length = ca.sqrt(ca.sumsqr(errors[:linear_count]) + _GRAM_REGULARIZATION)
        directions.append(ca.vertcat(errors[:linear_count] / length, ca.SX(parts.m - linear_count, 1)))
        travel_bound = sum((rho[i] * half_widths[i] for i in range(size)), ca.SX(0))
        tests.append(length - travel_bound - allowed_norms[0])
    for v in directions:  # the error along v minus the bound of its change over the box
        tests.append(ca.fabs(ca.dot(v, errors)) - ca.dot(ca.fabs(task_jacobian.T @ v), half_widths) - bound_errors(v.T))
    if cosine is not None:
        tests.append(ca.cos(ca.fmin(total_rotation + allowed_angle, np.pi)) - cosine)
    inverse = ca.horzcat(*[ca.vertcat(*factor.solve([ca.SX(float(i == k)) for i in range(parts.m)])) for k in range(parts.m)])
    gain = weighted.T @ inverse
    middle = -(gain @ errors)
    radius = ca.fabs(ca.SX.eye(size) - gain @ task_jacobian) @ half_widths + bound_errors(gain) + ROUNDING_M_RAD
    lower, upper = ca.fmax(middle - radius, -half_widths), ca.fmin(middle + radius, half_widths)
    margin = reduce(ca.fmax, [*tests, *ca.vertsplit(lower - upper)]) - ROUNDING_M_RAD
    new_half_widths = ca.fmax((upper - lower) / 2, 0)
    measures = _box_measures(
        half_widths,
        new_half_widths,
        ca.fabs(middle) + radius,
        [(rho[k] + _ORIENTATION_WEIGHT_M * rotates_tool[k]) * new_half_widths[k] for k in range(size)],
    )
    inputs = [centers, half_widths, target_position, target_rotation, tolerance, *([leg_vector] * is_along_leg)]
    return Kernel("box of joints", inputs, [margin, centers + (lower + upper) / 2, new_half_widths, *measures, middle, errors])


def _box_measures(half_widths: SX, new_half_widths: SX, reach: SX, widths: list[SX]) -> tuple[SX, SX, SX]:
    """Return whether a contracted box lies inside the old one, its volume fraction, and the index of its widest joint."""
    inside, volume, widest_joint, widest = ca.SX(-1), ca.SX(1), ca.SX(0), widths[0]
    for index, width in enumerate(widths):
        moves = half_widths[index] > 0
        inside = ca.fmax(inside, ca.if_else(moves, reach[index] - half_widths[index], -1))
        volume *= ca.if_else(moves, new_half_widths[index] / half_widths[index], 1)
        widest_joint, widest = ca.if_else(width > widest, index, widest_joint), ca.fmax(width, widest)
    return inside, volume, widest_joint


def is_orienting_joint(arm: Arm, parts: BoundedTask) -> list[bool]:
    """Return (n,) True for joints that change the orientation components; a joint along the tool's axis does not."""
    if parts.orientation == "none":
        return [False] * arm.n
    orients = [not joint.prismatic for joint in arm.joints]
    cosine = arm.tool[:3, 2] @ arm.joints[-1].axis
    if parts.orientation == "axis" and abs(abs(cosine) - 1) < 1e-12:
        orients[-1] = False
    return orients


def is_last_joint_idle(arm: Arm, parts: BoundedTask) -> bool:
    """Return True if the last joint changes no component: the tool point lies on its axis and rotation about it is free."""
    last = arm.joints[-1]
    is_on_axis = np.linalg.norm(np.cross(last.axis, arm.tool[:3, 3])) < 1e-12 * arm.length_unit
    return bool(not last.prismatic and is_on_axis and not is_orienting_joint(arm, parts)[-1])


def _nearest_axis_point(arm: Arm) -> FloatArray | None:
    """Return the point of the last axis nearest to the previous axis, in the last link's frame; None for a prismatic joint.

    A full pose determines every point of the tool; fewer joints move this point than the tool point, and they move it less.
    """
    last = arm.joints[-1]
    if last.prismatic or arm.n < 2:
        return None
    previous_axis, last_axis = arm.joints[-2].axis, last.origin[:3, :3] @ last.axis
    across = 1 - (previous_axis @ last_axis) ** 2
    if across < 1e-9:
        return np.zeros(3)
    offset = -last.origin[:3, 3]
    axis_coordinate = (offset @ last_axis - (offset @ previous_axis) * (previous_axis @ last_axis)) / across
    return np.asarray(axis_coordinate * last.axis)


def _axis_distance_bounds(arm: Arm, jacobian: SX, box: tuple[SX, SX], is_revolute: list[bool], point: FloatArray) -> list[SX]:
    """Return ``rho`` of every joint, for a point in the last link's frame."""
    # Prismatic joints count within the box, not within the arm's limits, because a lock may be outside of them.
    centers, half_widths = box
    extensions = [ca.fabs(centers[index]) + half_widths[index] for index in range(arm.n)]
    max_distances = bound_axis_distances(arm, ca.SX(float(np.linalg.norm(point))), extensions)
    rho: list[SX] = [ca.SX(1)] * arm.n
    outer_motion = ca.SX(0)
    for index in reversed(range(arm.n)):
        if is_revolute[index]:
            rho[index] = ca.fmin(max_distances[index], ca.sqrt(ca.sumsqr(jacobian[:3, index])) + outer_motion)
        outer_motion += rho[index] * half_widths[index]
    return rho


def _position_remainders(rho: list[SX], half_widths: SX, is_revolute: list[bool]) -> tuple[SX, SX]:
    """Bound the terms of order 2 and more, and those of order 3 and more, of the position in any direction."""
    second, third, inner = ca.SX(0), ca.SX(0), ca.SX(0)
    for index, revolute in enumerate(is_revolute):
        if revolute:
            outer = inner + half_widths[index]
            second += rho[index] * (outer**2 - inner**2) / 2
            third += rho[index] * (outer**3 - inner**3) / 6
            inner = outer
        else:
            second += rho[index] * half_widths[index] * inner
            third += rho[index] * half_widths[index] * inner**2 / 2
    return second, third


def _second_order_terms(
    second_derivative: Callable[[int, int], SX], half_widths: SX, inner: list[bool], outer: list[bool]
) -> SX:
    """Bound the second-order terms at the center; ``second_derivative`` takes a joint and one at least as far from the base."""
    total = ca.SX(0)
    for i in range(len(outer)):
        for k in range(i + 1):
            if inner[k] and outer[i]:
                total += ca.fabs(second_derivative(k, i)) * (
                    half_widths[k] * half_widths[i] if k < i else half_widths[i] ** 2 / 2
                )
    return total


def _smaller_remainder(second_order: SX, second_remainder: SX, third_remainder: SX) -> SX:
    """Return the smaller bound of each component's remainder."""
    return ca.vertcat(*[ca.fmin(second_remainder, term + third_remainder) for term in ca.vertsplit(ca.densify(second_order))])


def _orientation_terms(
    parts: BoundedTask, rotation: SX, angular_jacobian: SX, target_rotation: SX
) -> tuple[SX, SX, Callable[[int, int], SX], SX]:
    """Return the orientation components, their Jacobian, their second derivatives, and the cosine of the orientation error."""
    n = angular_jacobian.shape[1]
    if parts.orientation == "axis":
        axis, target_axes = rotation[:, 2], target_rotation[:, :2].T
        axis_jacobian = ca.horzcat(*[ca.cross(angular_jacobian[:, k], axis) for k in range(n)])
        return (
            target_axes @ axis,
            target_axes @ axis_jacobian,
            lambda k, i: target_axes @ ca.cross(angular_jacobian[:, k], axis_jacobian[:, i]),
            ca.dot(axis, target_rotation[:, 2]),
        )
    value = sum((ca.cross(target_rotation[:, i], rotation[:, i]) / 2 for i in range(3)), ca.SX(3, 1))
    error_rotation = target_rotation @ rotation.T
    rotated_jacobian = error_rotation @ angular_jacobian
    gradient = ca.horzcat(
        *[(ca.trace(error_rotation) * angular_jacobian[:, k] - error_rotation.T @ angular_jacobian[:, k]) / 2 for k in range(n)]
    )
    component_rows = ca.DM(parts.normal).T if parts.orientation == "plane" else ca.DM.eye(3)

    def second_derivative(k: int, i: int) -> SX:
        return component_rows @ (
            ca.cross(rotated_jacobian[:, k], angular_jacobian[:, i]) / 2
            - ca.dot(angular_jacobian[:, k], angular_jacobian[:, i]) * value
        )

    return component_rows @ value, component_rows @ gradient, second_derivative, (ca.trace(error_rotation) - 1) / 2
