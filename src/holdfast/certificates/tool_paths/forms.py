"""Enclosures of cells of lock instants and path: the cells that one configuration proves, and the continuation of one motion
from cell to cell.

The error of the locked arm is that of its tool relative to the tool of the healthy arm, so both chains are expanded. All
numbers here are doubles without error bounds; the verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.certificates.claims import TASK_ROWS
from holdfast.certificates.taylor import CertificateChain
from holdfast.certificates.tool_paths.cells import PATH_CENTER_UNIT, SEGMENT_INSTANTS, PathCellBatch, PathFormBatch
from holdfast.certificates.tool_paths.claims import PathClaim
from holdfast.certificates.tool_paths.tool_derivatives import (
    axial_vector,
    axial_vector_jacobian,
    axis_jacobian,
    directional_second_derivatives,
    solve_regularized,
    tangents_and_pseudo_inverses,
    transverse_axes,
)
from holdfast.certificates.tree import RowBatch
from holdfast.core.caching import cached_property
from holdfast.core.typing import BoolArray, FloatArray, IndexArray

_SECTION_ROUNDS = 30  # rounds that widen the section box until it suffices
_TIGHTENING_ROUNDS = 6  # rounds that narrow it afterwards
_VERIFIER_MARGIN = 1.003  # factor by which bounds must exceed those of the verifier
_MIN_SLACK = 1e-9  # m and rad: least distance from the bounds of the verifier
_MIN_ROTATION_TRACE = 2.91  # least trace of the remaining rotation at the middle
_MAX_ROTATION_CHANGE_RAD = 1.19  # largest rotation from the middle
_UNIQUE_BOX_SIZES = 0.25 * 0.5 ** np.arange(27)  # sizes of boxes with one solution, tried in this order
_ENCLOSURE_NEWTON_STEPS = 6
_NEWTON_TOLERANCE = 1e-10
_SECTION_FRACTION = 0.4  # fraction of a box with one solution that must contain it, so that the next cell can continue it
_FIRST_STEP_INSTANTS = SEGMENT_INSTANTS >> 8  # first step of the look-ahead
_MAX_STEP_INSTANTS = SEGMENT_INSTANTS >> 1
_MIN_STEP_INSTANTS = SEGMENT_INSTANTS >> 14
_TRACKING_TOLERANCE = 1e-6  # m and rad
_MAX_JOINT_JUMP = 0.3  # rad and m
_MAX_SECTION_SIZE = 10.0  # m and rad: no valid section box is wider


class LockedTrackingEnclosure:
    """Enclosure of a locked arm that tracks the tool of the healthy arm.

    Args:
        chain: Kinematic chain of the arm.
        knots: (K + 1, n) configurations of the healthy motion, rad.
        task: Task, with the components of the tool that follow the path.
        driven: Index of the locked joint, then those of the joints that continue the healthy motion.
        tube: (m,) half widths of the tube, m and rad, or (0,) without a tube.
        limits: (n, 2) joint limits, rad and m.
    """

    def __init__(
        self, chain: CertificateChain, knots: FloatArray, task: str, *, driven: list[int], tube: FloatArray, limits: FloatArray
    ) -> None:
        self.chain, self.knots, self.driven, self.tube, self.limits = chain, knots, driven, tube, limits
        self.n, self.slides, self._rows = knots.shape[1], chain.slides, TASK_ROWS[task]
        self.m = len(self._rows)
        self.uses_rotation, self._pointing = self._rows[-1] > 2, task == "pointing"
        self.free = [joint for joint in range(self.n) if joint not in driven]
        self._linear = sum(row < 3 for row in self._rows)
        self._revolute = np.tile(~chain.slides, 2).astype(float)

    @classmethod
    def from_claim(cls, claim: PathClaim, driven: list[int], tube: FloatArray) -> LockedTrackingEnclosure:
        """Make the enclosure of the arm of a claim on its motion."""
        chain, limits = CertificateChain.from_arm(claim.arm), np.column_stack([claim.arm.lower, claim.arm.upper])
        return cls(chain, claim.knots, claim.task, driven=driven, tube=tube, limits=limits)

    @cached_property
    def empty_form(self) -> PathFormBatch:
        """Form of one cell that encloses nothing."""
        return PathFormBatch.make_zero_form(self.n, self.m, 2 + len(self.tube) + self.m)

    def healthy_joints_and_rates(
        self, doubled_instants: IndexArray, rate_instants: IndexArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return healthy joints at half of ``doubled_instants``, and the rates over the segments of ``rate_instants``."""
        segment = (rate_instants - 1) // SEGMENT_INSTANTS
        rates = self.knots[segment + 1] - self.knots[segment]
        return self.knots[segment] + rates * (doubled_instants / (2 * SEGMENT_INSTANTS) - segment)[:, None], rates

    def set_driven_joints(self, q: FloatArray, cells: PathCellBatch) -> FloatArray:
        """Return configurations (N, n) with the driven joints at their values in the middles of cells."""
        q = q.copy()
        q[:, self.driven[0]] = self.healthy_joints_and_rates(cells.begin + cells.stop, cells.stop)[0][:, self.driven[0]]
        q[:, self.driven[1:]] = self.healthy_joints_and_rates(cells.start + cells.end, cells.end)[0][:, self.driven[1:]]
        return q

    def solve_centers(self, q: FloatArray, cells: PathCellBatch) -> FloatArray:
        """Run Newton's method from q (N, n) to the middles of cells, and round the result to units of the file."""
        q, (goal, _) = self.set_driven_joints(q, cells), self.healthy_joints_and_rates(cells.start + cells.end, cells.end)
        target = self.tool_pose_and_jacobian(goal)
        for _ in range(_ENCLOSURE_NEWTON_STEPS):
            tool_state = self.tool_pose_and_jacobian(q)
            error, jacobian = self.tracking_error_and_jacobian(tool_state, target)
            if np.abs(error).max(initial=0.0) < _NEWTON_TOLERANCE:
                break
            q[:, self.free] -= self._newton_step(error, jacobian)
        q[:, self.free] = np.round(q[:, self.free] / PATH_CENTER_UNIT) * PATH_CENTER_UNIT
        return q

    def _newton_step(self, error: FloatArray, jacobian: FloatArray) -> FloatArray:
        return np.clip(solve_regularized(jacobian[:, :, self.free], error[:, :, None])[:, :, 0], -0.5, 0.5)

    def enclose_cell_motions(self, q: FloatArray, cells: PathCellBatch) -> PathFormBatch:
        """Enclose the motion around the centers q (N, n) of cells."""
        m, n, tube = self.m, self.n, len(self.tube)
        goal, path_rate = self.healthy_joints_and_rates(cells.start + cells.end, cells.end)
        lock_rate = self.healthy_joints_and_rates(cells.begin + cells.stop, cells.stop)[1]
        tool_state, target = self.tool_pose_and_jacobian(q), self.tool_pose_and_jacobian(goal)
        error, jacobian = self.tracking_error_and_jacobian(tool_state, target)
        gradients = np.concatenate([jacobian, self._healthy_jacobian(tool_state, target)], axis=2)
        is_tangent, response = cells.width > 0, self._free_motion_response(gradients, lock_rate, path_rate, cells.width > 0)
        directions = np.zeros((len(q), 2 * n, 2 + tube + m))
        path_motion = path_rate[:, :, None] * response[:, -1:]
        directions[:, self.driven[0], 0] = lock_rate[:, self.driven[0]]
        directions[:, self.driven[1:]], directions[:, n:] = path_motion[:, self.driven[1:]], path_motion
        directions[:, self.free] = response[:, :-1]
        second = self._error_hessian(tool_state, target, directions)
        desired = np.concatenate([np.zeros((m, 2)), *[np.eye(m)] * (2 if tube else 1)], axis=1)
        half = np.concatenate([cells.half_widths, np.tile(self.tube, (len(q), 1)), np.zeros((len(q), m))], axis=1)
        positions = np.concatenate([q, goal], axis=1)
        bounds = _CellBounds(
            error=error, reach=np.abs(directions), left=np.abs(gradients @ directions - desired), second=np.abs(second),
            own=np.einsum("nacc->nac", second), out=np.abs(positions) * (1 - self._revolute),
        )  # fmt: skip
        closed, joint_travel, angle = self._find_invariant_section_boxes(bounds, half)
        s = half[:, -m:]
        unique_box, is_unique = np.zeros_like(s), np.zeros(len(q), dtype=bool)
        for size in _UNIQUE_BOX_SIZES:
            rows = np.flatnonzero(closed & ~is_unique)
            if not rows.size:
                break
            section_box = s[rows] + size
            is_contraction = self._has_unique_solution(bounds.select(rows), half[rows], section_box)
            unique_box[rows[is_contraction]], is_unique[rows[is_contraction]] = section_box[is_contraction], True
        lower, upper = self.limits[self.free].T
        travel = 1.001 * joint_travel[:, self.free] + 1e-7
        closed &= (s < _SECTION_FRACTION * unique_box).all(axis=1)
        is_valid = closed & is_unique & ((q[:, self.free] - travel >= lower) & (q[:, self.free] + travel <= upper)).all(axis=1)
        if self.uses_rotation:
            is_valid &= angle < _MAX_ROTATION_CHANGE_RAD
            is_valid &= self.compute_rotation_trace(tool_state, target) > _MIN_ROTATION_TRACE
        path_position = (cells.start + cells.end) / (2 * SEGMENT_INSTANTS)
        if (tangent_rows := np.flatnonzero(is_tangent)).size:
            overshoot = (path_position - (cells.end - 1) // SEGMENT_INSTANTS - 1)[tangent_rows]
            is_valid[tangent_rows] &= self._moves_forward(
                bounds.select(tangent_rows), half[tangent_rows], response[tangent_rows], overshoot
            )
        return PathFormBatch(q, path_position, is_tangent, response, half, unique_box, is_valid)

    def _free_motion_response(
        self, gradients: FloatArray, lock_rate: FloatArray, path_rate: FloatArray, is_tangent: BoolArray
    ) -> FloatArray:
        """Return the derivatives (N, m + 1, columns) of the free joints, then the path position, by the coordinates.

        They follow from the gradients (N, m, 2n) of the error.
        """
        m, n, tube = self.m, self.n, len(self.tube)
        jacobian, drift = gradients[:, :, self.free], gradients[:, :, self.driven[0]] * lock_rate[:, self.driven[:1]]
        path_gradient = np.einsum("nmk,nk->nm", gradients[:, :, n:], path_rate)
        path_gradient += np.einsum("nmk,nk->nm", gradients[:, :, self.driven[1:]], path_rate[:, self.driven[1:]])
        inverse = solve_regularized(jacobian, np.broadcast_to(np.eye(m), jacobian.shape))
        response = np.zeros((len(gradients), m + 1, 2 + tube + m))
        response[:, -1, 1] = 1
        response[:, :-1, :2] = -inverse @ np.stack([drift, path_gradient], axis=2)
        response[:, :-1, 2:] = np.concatenate([inverse] * (2 if tube else 1), axis=2)
        if is_tangent.any():
            matrices = np.concatenate([jacobian, path_gradient[:, :, None]], axis=2)[is_tangent]
            tangent, pseudo_inverse = tangents_and_pseudo_inverses(matrices)
            # On the diagonal, motions begin with the healthy rates, of which this part is along the tangent.
            lock_speed = (tangent[:, :-1] * lock_rate[is_tangent][:, self.free]).sum(axis=1) + tangent[:, -1]
            drifts = np.einsum("nkm,nm->nk", pseudo_inverse, drift[is_tangent])
            response[is_tangent, :, 0] = tangent * lock_speed[:, None] - drifts
            response[is_tangent, :, 1], response[is_tangent, :, 2:] = tangent, pseudo_inverse
        return response

    def continue_motion(
        self, is_first: BoolArray, previous: PathFormBatch, forms: PathFormBatch, cells: PathCellBatch
    ) -> BoolArray:
        """Return a mask of valid cells whose solution continues that of the previous cell, or starts at the lock instants."""
        continues = self.continues_previous_solution(previous, forms)
        return np.asarray(forms.good & np.where(is_first, self.contains_lock_configurations(forms, cells), continues))

    def contains_lock_configurations(self, forms: PathFormBatch, cells: PathCellBatch) -> BoolArray:
        """Return a mask of cells whose solutions contain the configurations at all lock instants of their slabs."""
        q, rate = (values[:, self.free] for values in self.healthy_joints_and_rates(cells.begin + cells.stop, cells.stop))
        start = np.column_stack([q, (cells.begin + cells.stop) / (2 * SEGMENT_INSTANTS)])
        departure = np.column_stack([rate, np.ones(len(q))])
        offsets = (departure - forms.own[:, :, 0]) * forms.half[:, :1]
        return self._is_in_unique_box(start, offsets[:, :, None], forms, np.zeros(len(q), dtype=bool))

    def continues_previous_solution(self, previous: PathFormBatch, forms: PathFormBatch) -> BoolArray:
        """Return a mask of cells whose solution is that of the previous cell, on the face where the previous cell ends."""
        end_q, end_position = self.cell_end_configurations(previous)
        columns = [column for column in range(previous.half.shape[1] - self.m) if column != 1]
        response_change = (previous.own - forms.own)[:, :, columns] * previous.half[:, None, columns]
        section_spread = previous.own[:, :, -self.m :] * previous.half[:, None, -self.m :]
        point = np.column_stack([end_q[:, self.free], end_position])
        return self._is_in_unique_box(point, np.concatenate([response_change, section_spread], axis=2), forms, previous.turned)

    def cell_end_configurations(self, forms: PathFormBatch) -> tuple[FloatArray, FloatArray]:
        """Return the configurations (N, n) and path positions (N,) where cells end, for the middles of their slabs."""
        q = forms.q.copy()
        q[:, self.free] += forms.own[:, :-1, 1] * forms.half[:, 1:2]
        return q, forms.place + forms.own[:, -1, 1] * forms.half[:, 1]

    def _is_in_unique_box(
        self, point: FloatArray, offsets: FloatArray, forms: PathFormBatch, was_tangent: BoolArray
    ) -> BoolArray:
        """Return a mask of cells whose unique box contains points (N, m + 1) with all offsets.

        ``was_tangent`` marks cells whose previous cell was a tangent cell.
        """
        matrix = forms.own[:, :, [1, *range(-self.m, 0)]]
        centers = np.column_stack([forms.q[:, self.free], forms.place])
        coordinates = solve_regularized(matrix, np.concatenate([(point - centers)[:, :, None], offsets], axis=2))
        max_coordinates = _VERIFIER_MARGIN * np.abs(coordinates).sum(axis=2) + _MIN_SLACK
        inside = (max_coordinates[:, 0] < forms.half[:, 1]) | ~(was_tangent | forms.turned)
        return np.asarray((max_coordinates[:, 1:] < forms.only).all(axis=1) & inside)

    def predict_cell_centers(self, previous: PathFormBatch, cells: PathCellBatch, distances: FloatArray) -> FloatArray:
        """Return predicted centers (N, n) of cells, ``distances`` (N,) segments behind the middles of the previous cells."""
        q = previous.q.copy()
        q[:, self.free] += previous.own[:, :-1, 1] * distances[:, None]
        return self.set_driven_joints(q, cells)

    def step_along_tangent(
        self, q: FloatArray, path_position: FloatArray, segment_starts: IndexArray, distances: FloatArray
    ) -> tuple[FloatArray, IndexArray]:
        """Step from configurations (N, n) by ``distances`` (N,) along the tangents, and correct back onto the motions."""
        z, end, locked_values = np.column_stack([q, path_position]), segment_starts + SEGMENT_INSTANTS, q[:, self.driven[0]]
        for iteration in range(_ENCLOSURE_NEWTON_STEPS):
            goal, path_rate = self.healthy_joints_and_rates(np.rint(2 * SEGMENT_INSTANTS * z[:, -1]), end)
            z[:, self.driven[1:]] = goal[:, self.driven[1:]]
            tool_state, target = self.tool_pose_and_jacobian(z[:, :-1]), self.tool_pose_and_jacobian(goal)
            error, jacobian = self.tracking_error_and_jacobian(tool_state, target)
            gradients = np.concatenate([jacobian, self._healthy_jacobian(tool_state, target)], axis=2)
            path_gradient = np.einsum("nmk,nk->nm", gradients[:, :, self.n :], path_rate)
            path_gradient += np.einsum("nmk,nk->nm", jacobian[:, :, self.driven[1:]], path_rate[:, self.driven[1:]])
            extended = np.concatenate([jacobian[:, :, self.free], path_gradient[:, :, None]], axis=2)
            transposed = extended.transpose(0, 2, 1)
            if iteration == 0:
                step = tangents_and_pseudo_inverses(extended)[0] * distances[:, None]
            else:
                step = -(transposed @ solve_regularized(extended @ transposed, error[:, :, None]))[:, :, 0]
            z[:, [*self.free, -1]] += step
            z[:, -1] = np.rint(z[:, -1] * SEGMENT_INSTANTS) / SEGMENT_INSTANTS
        z[:, self.free] = np.round(z[:, self.free] / PATH_CENTER_UNIT) * PATH_CENTER_UNIT
        z[:, self.driven[0]] = locked_values
        return z[:, :-1], np.rint(z[:, -1] * SEGMENT_INSTANTS).astype(np.int64)

    def can_finish_path(self, locks: IndexArray) -> BoolArray:
        """Return a mask of lock instants (N,) from which Newton's method follows the path to its end within the limits.

        This is a heuristic look-ahead.
        """
        path_end = (len(self.knots) - 1) * SEGMENT_INSTANTS
        q, (lower, upper) = self.healthy_joints_and_rates(2 * locks, np.maximum(locks, 1))[0], self.limits.T
        instants, steps, is_followed = locks.copy(), np.full(len(locks), _FIRST_STEP_INSTANTS), np.ones(len(locks), dtype=bool)
        while (active := np.flatnonzero(is_followed & (instants < path_end))).size:
            next_instants = np.minimum(instants[active] + steps[active], path_end)
            goal, next_q = self.healthy_joints_and_rates(2 * next_instants, next_instants)[0], q[active]
            target = self.tool_pose_and_jacobian(goal)
            next_q[:, self.driven[1:]] = goal[:, self.driven[1:]]
            for _ in range(_ENCLOSURE_NEWTON_STEPS):
                error, jacobian = self.tracking_error_and_jacobian(self.tool_pose_and_jacobian(next_q), target)
                if np.abs(error).max(initial=0.0) < _TRACKING_TOLERANCE:
                    break
                next_q[:, self.free] -= self._newton_step(error, jacobian)
            converged = (np.abs(error) < _TRACKING_TOLERANCE).all(axis=1) & ((next_q >= lower) & (next_q <= upper)).all(axis=1)
            converged &= (np.abs(next_q - q[active]) < _MAX_JOINT_JUMP).all(axis=1)
            q[active[converged]], instants[active[converged]] = next_q[converged], next_instants[converged]
            steps[active] = np.where(converged, np.minimum(2 * steps[active], _MAX_STEP_INSTANTS), steps[active] // 4)
            is_followed[active] = steps[active] >= _MIN_STEP_INSTANTS
        return is_followed

    # ---- kinematics --------------------------------------------------------------------------------------------

    def tool_pose_and_jacobian(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return position and rotation of the tool, rotation axes (N, n, 3), and derivatives of the position (N, n, 3)."""
        count, sine, cosine = len(q), np.sin(q), np.cos(q)
        position, rotation = np.zeros((count, 3)), np.tile(np.eye(3), (count, 1, 1))
        axes, points = np.empty((2, count, self.n, 3))
        for joint in range(self.n):
            rotation_rows = rotation.reshape(-1, 3)  # products of few large matrices are faster than of many small ones
            position = position + (rotation_rows @ self.chain.origins[joint]).reshape(count, 3)
            x, y, z = (rotation_rows @ self.chain.rotations[joint]).reshape(count, 3, 3).transpose(2, 0, 1)
            axes[:, joint], points[:, joint] = z, position
            s, c = sine[:, [joint]], cosine[:, [joint]]
            if self.slides[joint]:
                position, s, c = position + z * q[:, [joint]], np.zeros_like(s), np.ones_like(c)
            rotation = np.empty((count, 3, 3))
            rotation[:, :, 0], rotation[:, :, 1], rotation[:, :, 2] = c * x + s * y, c * y - s * x, z
        position = position + rotation @ self.chain.origins[self.n]
        spin, sliding = axes * ~self.slides[:, None], axes * self.slides[:, None]
        return position, rotation @ self.chain.rotations[self.n], spin, np.cross(spin, position[:, None] - points) + sliding

    def tracking_error_and_jacobian(
        self, tool_state: tuple[FloatArray, ...], target: tuple[FloatArray, ...]
    ) -> tuple[FloatArray, FloatArray]:
        """Return the tracking error (N, m) and its Jacobian by the arm's joints (N, m, n)."""
        error, jacobian = tool_state[0] - target[0], tool_state[3].transpose(0, 2, 1)
        if self.uses_rotation:
            rotation_error = tool_state[1] @ target[1].transpose(0, 2, 1)
            if self._pointing:
                angular_error = (transverse_axes(target) @ tool_state[1][:, :, 2:])[:, :, 0]
                angular_jacobian = transverse_axes(target) @ axis_jacobian(tool_state)
            else:
                angular_error = axial_vector(rotation_error)
                angular_jacobian = axial_vector_jacobian(rotation_error) @ tool_state[2].transpose(0, 2, 1)
            error = np.concatenate([error, angular_error], axis=1)
            jacobian = np.concatenate([jacobian, angular_jacobian], axis=1)
        return error[:, self._rows], jacobian[:, self._rows]

    def compute_rotation_trace(self, tool_state: tuple[FloatArray, ...], target: tuple[FloatArray, ...]) -> FloatArray:
        """Return the traces (N,), 1 + 2 cos(angle), of the rotations between the tools and their targets."""
        rotation, wanted = tool_state[1], np.broadcast_to(target[1], tool_state[1].shape)
        if self._pointing:
            return np.asarray(1 + 2 * np.einsum("ni,ni->n", rotation[:, :, 2], wanted[:, :, 2]))
        return np.asarray(np.einsum("nij,nij->n", rotation, wanted))

    def _healthy_jacobian(self, tool_state: tuple[FloatArray, ...], target: tuple[FloatArray, ...]) -> FloatArray:
        """Return the Jacobian (N, m, n) of the error by the healthy arm's joints."""
        jacobian = -target[3].transpose(0, 2, 1)
        if self.uses_rotation:
            rotation_error = tool_state[1] @ target[1].transpose(0, 2, 1)
            angular_jacobian = axial_vector_jacobian(rotation_error) @ rotation_error @ target[2].transpose(0, 2, 1)
            if self._pointing:
                angular_jacobian = transverse_axes(target) @ axis_jacobian(target)
            jacobian = np.concatenate([jacobian, -angular_jacobian], axis=1)
        return np.asarray(jacobian[:, self._rows])

    def _error_hessian(
        self, tool_state: tuple[FloatArray, ...], target: tuple[FloatArray, ...], directions: FloatArray
    ) -> FloatArray:
        """Return the second derivatives (N, m, c, c) of the error along the columns of ``directions``."""
        n, locked_moves, healthy_moves = self.n, directions[:, : self.n], directions[:, self.n :]
        # Joints before k rotate the column of joint k; the sum contains every pair once.
        second = directional_second_derivatives(tool_state[2], tool_state[3], locked_moves)
        second = second - directional_second_derivatives(target[2], target[3], healthy_moves)
        if self._pointing:
            locked_axis, healthy_axis = (
                directional_second_derivatives(state[2], axis_jacobian(state).transpose(0, 2, 1), moves)
                for state, moves in ((tool_state, locked_moves), (target, healthy_moves))
            )
            rows = np.einsum("nri,nicd->nrcd", transverse_axes(target), locked_axis - healthy_axis)
            second = np.concatenate([second, rows], axis=1)
        elif self.uses_rotation:
            rotation_error = tool_state[1] @ target[1].transpose(0, 2, 1)
            axes = np.concatenate([tool_state[2], -(rotation_error[:, None] @ target[2][..., None])[..., 0][:, ::-1]], axis=1)
            moves = np.concatenate([locked_moves, healthy_moves[:, ::-1]], axis=1)
            cumulative = np.cumsum(axes[:, :, None] * moves[..., None], axis=1)  # (N, 2n, c, 3)
            midpoints = cumulative - axes[:, :, None] * moves[..., None] / 2  # a joint with itself has half the weight
            rotated = np.cross(axes[:, :, None, :], rotation_error.transpose(0, 2, 1)[:, None])  # rows: z x each column of off
            derivative_maps = axial_vector_jacobian(rotated.transpose(0, 1, 3, 2).reshape(-1, 3, 3)).reshape(
                len(rotation_error), 2 * n, 3, 3
            )
            half_terms = np.einsum("nkri,nkai,nkb->nrab", derivative_maps, midpoints, moves, optimize=True)
            second = np.concatenate([second, half_terms + half_terms.transpose(0, 1, 3, 2)], axis=1)
        return np.asarray(second[:, self._rows])

    # ---- bounds ------------------------------------------------------------------------------------------------

    def _third_order_remainder(self, joint_travel: FloatArray, slide_extent: FloatArray) -> FloatArray:
        """Return the remainder (N, m) after second order; ``slide_extent`` (N, 2n) is that of the prismatic joints."""
        position_remainder, slide_range = np.zeros(len(joint_travel)), joint_travel * (1 - self._revolute)
        for joints in (slice(0, self.n), slice(self.n, None)):
            c = np.cumsum((joint_travel * self._revolute)[:, joints], axis=1)
            max_lengths = self.chain.lengths + (slide_extent + slide_range)[:, joints]
            position_remainder += (c**3 * max_lengths + 3 * c**2 * slide_range[:, joints]).sum(axis=1) / 6
        rotation_remainder = (joint_travel @ self._revolute) ** 3 / 6
        return np.stack([position_remainder] * self._linear + [rotation_remainder] * (self.m - self._linear), axis=1)

    def _find_invariant_section_boxes(self, bounds: _CellBounds, half: FloatArray) -> tuple[BoolArray, FloatArray, FloatArray]:
        """Find section boxes that are mapped into themselves, store them in ``half``, and return mask, travel, and rotation."""
        count, s = len(half), half[:, -self.m :]
        closed, rows = np.zeros(count, dtype=bool), np.arange(count)
        joint_travel, angle = np.full((count, 2 * self.n), _MAX_SECTION_SIZE), np.full(count, _MAX_SECTION_SIZE)
        for iteration in range(_SECTION_ROUNDS + _TIGHTENING_ROUNDS):
            if not rows.size and iteration < _SECTION_ROUNDS:  # every box is decided
                continue
            rows = np.flatnonzero(closed) if iteration >= _SECTION_ROUNDS else rows
            excess, joint_travel[rows], angle[rows] = self._bound_error_and_motion(bounds.select(rows), half[rows])
            is_closed = (_VERIFIER_MARGIN * excess + _MIN_SLACK <= s[rows]).all(axis=1) & (s[rows] < 1).all(axis=1)
            closed[rows] = is_closed
            if iteration < _SECTION_ROUNDS:
                rows, wider = rows[~is_closed], 1.05 * excess[~is_closed] + 2 * _MIN_SLACK
                s[rows] = np.clip(np.nan_to_num(wider, nan=_MAX_SECTION_SIZE), 0, _MAX_SECTION_SIZE)
                rows = rows[(s[rows] < 1).all(axis=1)]
            else:
                s[rows] = _VERIFIER_MARGIN * excess + 1.01 * _MIN_SLACK
        return closed, joint_travel[:, : self.n], angle

    def _bound_error_and_motion(self, bounds: _CellBounds, half: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Bound the distance of the error from the section, the joint travel, and the rotation of the tool."""
        joint_travel, square = (bounds.reach @ half[:, :, None])[:, :, 0], half**2
        remainder = self._third_order_remainder(joint_travel, bounds.out) + (bounds.left @ half[:, :, None])[:, :, 0]
        mixed = ((bounds.second @ half[:, None, :, None])[..., 0] * half[:, None]).sum(axis=2)
        remainder += (mixed - (np.abs(bounds.own) @ square[:, :, None])[:, :, 0]) / 2
        upper, lower = (
            remainder + (np.maximum(curvature, 0) @ square[:, :, None])[:, :, 0] / 2 for curvature in (bounds.own, -bounds.own)
        )
        return np.maximum(bounds.error + upper, lower - bounds.error), joint_travel, joint_travel @ self._revolute

    def _bound_residual_gradients(self, bounds: _CellBounds, half: FloatArray) -> FloatArray:
        """Bound the gradients (N, m, 1 + m) of the error less the section by the path and by the section."""
        columns = [1, *range(half.shape[1] - self.m, half.shape[1])]
        joint_travel = (bounds.reach @ half[:, :, None])[:, :, 0]
        gradients = bounds.left[:, :, columns] + (bounds.second @ half[:, None, :, None])[:, :, columns, 0]
        angle_gradient, slide_range = np.zeros((len(half), 1 + self.m)), joint_travel * (1 - self._revolute)
        response = bounds.reach[:, :, columns]
        for joints in (slice(0, self.n), slice(self.n, None)):
            revolute = self._revolute[joints]
            c = np.cumsum(joint_travel[:, joints] * revolute, axis=1)
            cumulative = np.cumsum(response[:, joints] * revolute[:, None], axis=1)
            weights = (self.chain.lengths + (bounds.out + slide_range)[:, joints]) * c**2 + 2 * c * slide_range[:, joints]
            slides = (c**2 * (1 - revolute))[:, None] @ response[:, joints]
            gradients[:, : self._linear] += (weights[:, None] @ cumulative + slides) / 2
            angle_gradient += cumulative[:, -1]
        gradients[:, self._linear :] += (angle_gradient * (joint_travel @ self._revolute)[:, None] ** 2 / 2)[:, None]
        return np.asarray(gradients)

    def _has_unique_solution(self, bounds: _CellBounds, half: FloatArray, section_box: FloatArray) -> BoolArray:
        """Return a mask of the section boxes (N, m) with at most one solution."""
        gradients = self._bound_residual_gradients(bounds, np.concatenate([half[:, : -self.m], section_box], axis=1))[:, :, 1:]
        return np.asarray((_VERIFIER_MARGIN * (gradients @ section_box[:, :, None])[:, :, 0] < 0.998 * section_box).all(axis=1))

    def _moves_forward(self, bounds: _CellBounds, half: FloatArray, response: FloatArray, overshoot: FloatArray) -> BoolArray:
        """Return a mask of tangent cells that only move forward on the path and end within their segment.

        ``overshoot`` (N,) is measured from the end of the segment.
        """
        gradients = self._bound_residual_gradients(bounds, half)
        section_rates = solve_regularized(np.eye(self.m) - gradients[:, :, 1:], gradients[:, :, :1])[:, :, 0]
        slowdown = (np.abs(response[:, -1, -self.m :]) * section_rates).sum(axis=1)
        extent = (np.abs(response[:, -1]) * half).sum(axis=1)
        is_forward = (section_rates >= 0).all(axis=1) & (_VERIFIER_MARGIN * slowdown < response[:, -1, 1])
        return np.asarray(is_forward & (overshoot + _VERIFIER_MARGIN * extent < 0))


@dataclass(frozen=True, eq=False)
class _CellBounds(RowBatch):
    """Bounds of cells: errors, response, gradient residual, magnitudes of second derivatives, curvature, slide extents."""

    error: FloatArray
    reach: FloatArray
    left: FloatArray
    second: FloatArray
    own: FloatArray
    out: FloatArray
