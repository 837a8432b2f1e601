"""Kernels of the Taylor form, with error, derivatives and bounds around a configuration, for any locked joint."""

from __future__ import annotations

from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from holdfast.core.caching import cached_property
from holdfast.core.labels import TASK_SIZES
from holdfast.core.typing import FloatArray
from holdfast.kernels.disk_cache import cached_kernel
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import Cholesky, damped_least_norm
from holdfast.kernels.loop import Loop
from holdfast.kernels.program import SX
from holdfast.model.arm import kinematics
from holdfast.model.arm.model import Arm

CELL_WIDTH_PARTS = 16  # parts of a cell's width in which the proved fraction is expressed
ROUNDS_PER_STEP = 5
_MAX_SECTION_ROUNDS = 30  # rounds of a test, each with a section box slightly wider than the previous one needs
_MAX_SECTION_ERROR = 0.5  # m or rad: no section box suffices for a larger error
_MAX_NEWTON_STEP_RAD = 0.5  # rad in one step of Newton's method
# The error of a rotation is 0 for half a turn, too, so its cosine and the sum of its angles have limits.
_MIN_ROTATION_COSINE = 0.951
_MAX_ROTATION_CHANGE_RAD = 1.45


@dataclass(frozen=True)
class RotationError:
    """Remaining rotation error, whose components are products of fixed matrices with the entries of a rotation.

    Attributes:
        rotation: (3, 3) rotation from the target to the tool.
        weights: (3, 3) weights of each row.
        cosine_weights: (3, 3) weights of the cosine, up to a constant.
        cosine: Cosine of the angle.
        target_axes: Axes about which the target's angles rotate it.
    """

    rotation: SX
    weights: list[SX]
    cosine_weights: SX
    cosine: SX
    target_axes: list[SX]

    @property
    def components(self) -> SX:
        """(k,) components of the error, which are 0 if no rotation remains."""
        return ca.vertcat(*[ca.sum1(ca.sum2(weight * self.rotation)) for weight in self.weights])

    def differentiate_components_by_rotation(self, matrix: SX) -> SX:
        """Return the derivatives (k, 3) of the components by rotations about the base axes, applied to a matrix."""
        return ca.vertcat(*[_axial_vector(weight @ matrix.T).T for weight in self.weights])


class ToolExpansion:
    """Symbolic error of an arm's tool, with its point and, if the task includes it, its rotation.

    A mask (n,) marks the free joints, and a second mask (n,) the locked joint, all 0 for a healthy arm. A target consists of
    the coordinates of its point and, for tasks with a rotation, of the target's angles or nine numbers of a rotation. A form
    contains the relevant numbers of the Taylor form: the error (m,); ``|B|`` (n, m), the response of the joints to the section
    and to the target's point; ``|L|`` (n, t + 1), their response to the t angles and the locked joint; second derivatives
    (m, pairs) by pairs of these m + t + 1 coordinates; and the extents (n,) of prismatic joints, m.

    Args:
        arm: The arm.
        task: ``planar``, ``planar-pose``, ``position``, ``pointing`` or ``pose``.
        turning: Number t of target angles: 3 for rotating targets of a pose, 1 in the plane, else 0.
        lengths: (n,) lengths, m, that each joint and those before it rotate; see
            :class:`holdfast.certificates.taylor.CertificateChain`.
        slides: (n,) True for prismatic joints.

    Attributes:
        m: Number of task rows.
        linear: Number of position rows among them.
        axes: Number of coordinates of a target.
    """

    def __init__(self, arm: Arm, task: str, turning: int, lengths: FloatArray, slides: NDArray[np.bool_]) -> None:
        self.arm, self.task, self.turning, self.lengths, self.slides = arm, task, turning, lengths, slides
        self.m, self.linear = TASK_SIZES[task], 2 if task.startswith("planar") else 3
        self.axes, self.coordinates = self.linear + turning, self.m + turning + 1
        self.pairs = [(first, second) for first in range(self.coordinates) for second in range(first, self.coordinates)]

    @property
    def uses_rotation(self) -> bool:
        """True if the task includes the rotation of the tool."""
        return self.m > self.linear

    @property
    def target_size(self) -> int:
        """Number of values of a target in the kernels."""
        return self.linear + (self.turning or 9 if self.uses_rotation else 0)

    # ---- error and derivatives ---------------------------------------------------------------------------------

    def _target_rotation_and_axes(self, target: SX) -> tuple[SX, list[SX]]:
        """Return the rotation of a target and the axes about which its angles rotate it."""
        if not self.turning:
            return ca.reshape(target[3:], 3, 3).T, []
        if self.turning == 1:
            return _axis_rotation(2, target[2]), [ca.SX([0, 0, 1])]
        roll, pitch, yaw = (_axis_rotation(axis, target[3 + axis]) for axis in range(3))
        return yaw @ pitch @ roll, [(yaw @ pitch)[:, 0], yaw[:, 1], ca.SX([0, 0, 1])]

    def _chain_and_tool_jacobian(self, q: SX) -> tuple[kinematics.KinematicChain, SX]:
        """Return the kinematic chain and the (6, n) Jacobian of the tool's position and rotation."""
        chain = kinematics.kinematic_chain(self.arm, q)
        return chain, kinematics.chain_jacobian(self.arm, chain, chain.position)

    def _task_jacobian(self, chain: kinematics.KinematicChain, jacobian: SX) -> SX:
        """Return the task rows (m, n) of a Jacobian, which are valid at the target rotation of the tool."""
        angular = {
            "planar-pose": jacobian[5, :],
            "pointing": (chain.rotation.T @ jacobian[3:, :])[:2, :],
            "pose": jacobian[3:, :],
        }
        return ca.vertcat(jacobian[: self.linear, :], *([angular[self.task]] if self.uses_rotation else []))

    def _rotation_error(self, chain: kinematics.KinematicChain, target: SX) -> RotationError:
        """Return the rotation error of the tool."""
        target_rotation, axes = self._target_rotation_and_axes(target)
        rotation = chain.rotation @ target_rotation.T
        if self.task == "pointing":
            direction = target_rotation[:, 2]
            cross_weights = [target_rotation[:, k] @ direction.T for k in range(2)]
            cosine = ca.dot(rotation @ direction, direction)
            return RotationError(rotation, cross_weights, direction @ direction.T, cosine, axes)
        skew_weights = [ca.skew(ca.SX.eye(3)[:, k]) / 2 for k in range(2 if self.task == "planar-pose" else 0, 3)]
        return RotationError(rotation, skew_weights, ca.SX.eye(3) / 2, (ca.trace(rotation) - 1) / 2, axes)

    def _pose_error(self, chain: kinematics.KinematicChain, target: SX) -> tuple[SX, SX]:
        """Return the position error (2,) or (3,), m, and the rotation error 2 sin(angle / 2) about the axes of the task."""
        position_error = chain.position[: self.linear] - target[: self.linear]
        if not self.uses_rotation:
            return position_error, ca.SX(0, 1)
        rotation_error = self._rotation_error(chain, target)
        return position_error, rotation_error.components / ca.sqrt(ca.fmax((1 + rotation_error.cosine) / 2, 1e-12))

    def error_and_derivatives(self, q: SX, target: SX, with_cosine: bool = False) -> tuple[SX, SX, list[SX]]:
        """Return the error (m,), its gradients (m, n + t) and the Hessians of its rows, by joints and angles of the target.

        ``with_cosine`` adds a row with the cosine of the angle minus 1 for tasks with a rotation.
        """
        n, t, linear = self.arm.n, self.turning, self.linear
        chain, jacobian = self._chain_and_tool_jacobian(q)
        columns, axes = jacobian[:3, :], jacobian[3:, :]
        error = chain.position[:linear] - target[:linear]
        gradients = ca.horzcat(columns[:linear, :], ca.SX(linear, t))
        hessians = [ca.SX(n + t, n + t) for _ in range(self.m + (with_cosine and self.uses_rotation))]
        for j in range(n):
            for k in range(j, n):  # the second derivative by joint j and a later k is z_j x J_k
                second = ca.cross(axes[:, j], columns[:, k])
                for row in range(linear):
                    hessians[row][j, k] = hessians[row][k, j] = second[row]
        if self.uses_rotation:
            # A rotation of the target multiplies the error R(q) R' from the right; its axes are in order from left to right.
            rotation_error = self._rotation_error(chain, target)
            offsets = 10 * (rotation_error.cosine < _MIN_ROTATION_COSINE)
            if with_cosine:
                cosine_offsets = ca.vertcat(ca.SX(self.m - linear, 1), 1 if self.task == "pointing" else 1.5)
                weights = [*rotation_error.weights, rotation_error.cosine_weights]
                rotation_error, offsets = replace(rotation_error, weights=weights), -cosine_offsets
            rotation_axes = ca.horzcat(axes, *[-(rotation_error.rotation @ axis) for axis in rotation_error.target_axes])
            error = ca.vertcat(error, rotation_error.components + offsets)
            differentiate, rotation = rotation_error.differentiate_components_by_rotation, rotation_error.rotation
            gradients = ca.vertcat(gradients, differentiate(rotation) @ rotation_axes)
            for k in range(n + t):
                by_k = differentiate(ca.skew(rotation_axes[:, k]) @ rotation)
                for j in range(k + 1):
                    second = by_k @ rotation_axes[:, j]
                    for row in range(len(rotation_error.weights)):
                        hessians[linear + row][j, k] = hessians[linear + row][k, j] = second[row]
        return error, gradients, hessians

    @property
    def _input_symbols(self) -> tuple[SX, SX, SX]:
        """Symbols of the joints, the target and the mask of free joints."""
        return kinematics.joint_symbols(self.arm), ca.SX.sym("x", self.target_size), ca.SX.sym("free", self.arm.n)

    def _pseudo_inverse(self, jacobian: SX, free: SX) -> SX:
        """Return the pseudo-inverse (n, m) on the free joints."""
        free_jacobian = jacobian @ ca.diag(free)
        gram = free_jacobian @ free_jacobian.T
        factor = Cholesky([[gram[i, k] for k in range(self.m)] for i in range(self.m)])
        columns = [ca.vertcat(*factor.solve(ca.vertsplit(ca.SX.eye(self.m)[:, k]))) for k in range(self.m)]
        return free_jacobian.T @ ca.horzcat(*columns)

    @cached_property
    @cached_kernel
    def taylor_form_kernel(self) -> Kernel:
        """Kernel from joints, target, free and locked joints, and the largest extent of a locked slide to the Taylor form."""
        (q, target, free), n, t = self._input_symbols, self.arm.n, self.turning
        locked, slide_extent = ca.SX.sym("locked", n), ca.SX.sym("held", n)
        error, gradients, hessians = self.error_and_derivatives(q, target)
        inverse = self._pseudo_inverse(gradients[:, :n], free)
        response = ca.horzcat(-inverse @ gradients[:, n:], locked - inverse @ (gradients[:, :n] @ locked))
        directions = ca.vertcat(ca.horzcat(inverse, response), ca.horzcat(ca.SX(t, self.m), ca.SX.eye(t), ca.SX(t, 1)))
        curvatures = [directions.T @ hessian @ directions for hessian in hessians]
        by_pair = ca.vertcat(*[ca.horzcat(*[curvature[a, b] for a, b in self.pairs]) for curvature in curvatures])
        extents = ca.fmax(ca.fabs(q), slide_extent) * self.slides.astype(float)
        outputs = [ca.densify(output) for output in (error, ca.fabs(inverse), ca.fabs(response), by_pair, extents)]
        return Kernel("Taylor form of a reach", [q, target, free, locked, slide_extent], outputs)

    @cached_property
    @cached_kernel
    def error_derivative_kernel(self) -> Kernel:
        """Kernel from joints and target to the task rows with the cosine row, then their gradients and their Hessians."""
        q, target, _ = self._input_symbols
        error, gradients, hessians = self.error_and_derivatives(q, target, with_cosine=True)
        return Kernel("rows of a task", [q, target], [ca.densify(output) for output in (error, gradients, *hessians)])

    # ---- bounds ------------------------------------------------------------------------------------------------

    @property
    def _form_symbol(self) -> SX:
        return ca.SX.sym("form", self.m * (1 + len(self.pairs)) + self.arm.n * (self.coordinates + 1))

    def _error_bound_expressions(self, form: SX, cell: SX, section: SX) -> tuple[SX, SX, SX, SX]:
        m, n, t, linear = self.m, self.arm.n, self.turning, self.linear
        sizes = [0, m, m * n, (t + 1) * n, m * len(self.pairs), n]
        error, inverse, response, second, slide_extent = ca.vertsplit(form, np.cumsum(sizes).tolist())
        targets = ca.vertcat(cell[:linear], ca.SX(m - linear, 1))  # target coordinates that joints follow like the section
        half_widths = ca.vertcat(targets + section, cell[linear:])
        joint_travel = ca.reshape(inverse, m, n).T @ half_widths[:m] + ca.reshape(response, t + 1, n).T @ half_widths[m:]
        second = ca.reshape(second, len(self.pairs), m).T
        remainder, angle = ca.SX(0), ca.SX(0)
        for k in range(n):
            length = float(self.lengths[k])
            if self.slides[k]:
                extent = length + slide_extent[k] + joint_travel[k]
                remainder += (angle * angle * angle * extent + 3 * angle * angle * joint_travel[k]) / 6
            else:
                angle += joint_travel[k]
                remainder += length / 6 * angle * angle * angle
        for k in range(t):
            angle += cell[linear + k]
        upper, lower = [], []
        for row in range(m):
            shared, upward, downward = remainder if row < linear else angle * angle * angle / 6, ca.SX(0), ca.SX(0)
            for column, (a, b) in enumerate(self.pairs):
                value = second[row, column]
                if a < b:
                    shared += ca.fabs(value) * half_widths[a] * half_widths[b]
                    continue
                square = half_widths[a] * half_widths[a]
                if a < linear:
                    shared += ca.fabs(value) * cell[a] * section[a]
                    square = cell[a] * cell[a] + section[a] * section[a]
                upward, downward = upward + ca.fmax(value, 0) * square / 2, downward + ca.fmax(-value, 0) * square / 2
            upper.append(error[row] + shared + upward)
            lower.append(-error[row] + shared + downward)
        return ca.vertcat(*upper), ca.vertcat(*lower), joint_travel, angle

    @cached_property
    @cached_kernel
    def error_bound_kernel(self) -> Kernel:
        """Kernel from a form and half widths of cell (axes + 1,) and section (m,) to bounds of the error and joint travel.

        The bounds are those of the error minus s, above and below 0.
        """
        form, cell, section = self._form_symbol, ca.SX.sym("w", self.axes + 1), ca.SX.sym("s", self.m)
        bounds = self._error_bound_expressions(form, cell, section)[:3]
        return Kernel("bounds of a Taylor form", [form, cell, section], list(bounds))

    @cached_property
    @cached_kernel
    def cell_test_loop(self) -> Loop:
        """Loop from a form, a cell and joint margins to the proved part of the cell, in sixteenths of its width.

        Tests follow one another until no sixteenth lies between those that passed and failed. The state consists of a section
        box (m,), which grows from 0 in each test; the largest number of sixteenths that passed; the tested number; the step to
        the next number; and the rounds of this test. The last test leaves its final box.
        """
        form, cell, section = self._form_symbol, ca.SX.sym("w", self.axes + 1), ca.SX.sym("s", self.m)
        joint_margin = ca.SX.sym("room", self.arm.n)
        start = state = ca.vertcat(section, *[ca.SX.sym(name) for name in ("passed", "now", "more", "rounds")])
        for _ in range(ROUNDS_PER_STEP):  # a step has overhead, so it contains several rounds
            state = self._next_test_state(state, form, cell, joint_margin)
        return Loop(
            "section box of a cell", start, [form, cell, joint_margin], next_state=state, residual=state[self.m + 2], ahead=True
        )

    def _next_test_state(self, state: SX, form: SX, cell: SX, joint_margin: SX) -> SX:
        """Return the state after one round: a slightly wider section box, or the start of the next test."""
        section, (passed, tested, increment, rounds) = state[: self.m], ca.vertsplit(state[self.m :])
        upper, lower, joint_travel, angle = self._error_bound_expressions(form, cell * (tested / CELL_WIDTH_PARTS), section)
        error, inside = ca.fmax(upper, lower), ca.mmax(1.001 * joint_travel + 1e-6 - joint_margin) <= 0
        if self.uses_rotation:
            inside = ca.logic_and(inside, angle < _MAX_ROTATION_CHANGE_RAD)
        closed, finished = ca.mmax(1.002 * error + 2e-7 - section) <= 0, increment < 1
        succeeds = ca.logic_and(closed, inside)
        diverged = ca.logic_or(ca.mmax(error) >= _MAX_SECTION_ERROR, rounds >= _MAX_SECTION_ROUNDS - 1)
        ended = ca.logic_and(ca.logic_not(finished), ca.logic_or(closed, ca.logic_or(ca.logic_not(inside), diverged)))
        next_section = ca.if_else(ca.logic_or(finished, closed), section, ca.fmin(1.05 * error + 2.5e-7, 1.0))
        # In the last test, no number lies between those that passed and failed.
        is_last = ca.if_else(succeeds, tested >= CELL_WIDTH_PARTS - 1, tested - passed <= 1)
        next_increment = ca.if_else(is_last, 0, increment / 2)
        has_next = ca.logic_and(ended, next_increment >= 1)
        passed = ca.if_else(ca.logic_and(ended, succeeds), tested, passed)
        return ca.vertcat(
            ca.if_else(has_next, 0, next_section),
            passed,
            ca.if_else(has_next, ca.fmin(passed + next_increment, CELL_WIDTH_PARTS - 1), tested),
            ca.if_else(ended, next_increment, increment),
            ca.if_else(ended, 0, rounds + 1),
        )

    # ---- configurations ----------------------------------------------------------------------------------------

    @cached_property
    @cached_kernel
    def newton_loop(self) -> Loop:
        """Newton loop from joints to a target with a given error (m,), on the free joints, within limits."""
        q, target, free = self._input_symbols
        error, lower, upper = ca.SX.sym("e", self.m), ca.SX.sym("low", self.arm.n), ca.SX.sym("high", self.arm.n)
        chain, jacobian = self._chain_and_tool_jacobian(q)
        residual = error - ca.vertcat(*self._pose_error(chain, target))  # the axial part would be 0 for half a turn, too
        task_jacobian = self._task_jacobian(chain, jacobian)
        if self.task == "pointing":  # across the target axis, not the tool's axis
            rotation_error = self._rotation_error(chain, target)
            by_rotation = rotation_error.differentiate_components_by_rotation(rotation_error.rotation)
            task_jacobian = ca.vertcat(task_jacobian[:3, :], by_rotation @ jacobian[3:, :])
        step = damped_least_norm(task_jacobian @ ca.diag(free), residual, 1e-8)
        step *= ca.fmin(1, _MAX_NEWTON_STEP_RAD / ca.fmax(ca.mmax(ca.fabs(step)), 1e-12))
        next_q = ca.fmin(ca.fmax(q + step, lower), upper) * free + q * (1 - free)
        inputs = [target, error, free, lower, upper]
        return Loop("configuration of a target", q, inputs, next_state=next_q, residual=ca.sumsqr(residual))

    @cached_property
    @cached_kernel
    def pose_error_kernel(self) -> Kernel:
        """Kernel from joints and target to the position error of the tool, m, and its orientation error, rad."""
        q, target, _ = self._input_symbols
        distances = [
            ca.sqrt(ca.sumsqr(component)) if component.numel() else ca.SX(0)
            for component in self._pose_error(self._chain_and_tool_jacobian(q)[0], target)
        ]
        return Kernel("distance from a target", [q, target], distances)

    @cached_property
    @cached_kernel
    def self_motion_kernel(self) -> Kernel:
        """Kernel from joints, a joint move and free joints to the part of it that keeps the tool still, to first order."""
        (q, _, free), move = self._input_symbols, ca.SX.sym("d", self.arm.n)
        jacobian, free_move = self._task_jacobian(*self._chain_and_tool_jacobian(q)), move * free
        self_motion = free_move - self._pseudo_inverse(jacobian, free) @ (jacobian @ free_move)
        return Kernel("self-motion of a reach", [q, move, free], [self_motion])


def _axis_rotation(axis: int, angle: SX) -> SX:
    """Return the rotation matrix about a coordinate axis."""
    i, j, matrix = (axis + 1) % 3, (axis + 2) % 3, ca.SX.eye(3)
    matrix[i, i], matrix[j, j], matrix[i, j], matrix[j, i] = ca.cos(angle), ca.cos(angle), -ca.sin(angle), ca.sin(angle)
    return matrix


def _axial_vector(matrix: SX) -> SX:
    """Return the vector (3,) whose product with z is that of the matrix [z] with a matrix."""
    return ca.vertcat(matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1])
