"""Taylor form of a reach, which determines the boxes of targets and locked values that one configuration proves.

Around a configuration the free joints follow the target and the locked joint along ``q = q_c + D (delta, s)``. If the bound
``e(S)`` of the remaining error is at most S, ``s -> s - g`` maps the box S of corrections into itself. By Brouwer's theorem it
then has a fixed point, at which g = 0. All numbers here are doubles without error bounds; the verifier decides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.expansions import CELL_WIDTH_PARTS, ToolExpansion
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.model.arm.configurations import align_joint_frames
from holdfast.model.arm.model import Arm

CENTER_UNIT = 2.0**-24  # rad: unit of stored centers
_MAX_TEST_STEPS = 40  # steps of tests, each with several rounds
_SINGULAR_ERROR = 1e6  # m: error that stands for a singular arm
_NO_LIMIT = 1e6  # rad or m: stands for no limit
_MAX_SLIDE_M = 5.0  # m: range that is tried for a prismatic joint without limits


@dataclass(frozen=True, eq=False)
class CertificateChain:
    """Joints about or along the z axes of their frames, in the form that certificates contain.

    Attributes:
        rotations: (n + 1, 3, 3) rotation of each joint's frame in the previous frame, then of the tool.
        origins: (n + 1, 3) origin of each joint's frame in the previous frame, then of the tool, m.
        lengths: (n,) lengths, m, that joint k and the joints before it rotate, but joint k + 1 does not; for a prismatic joint
            without its value.
        slides: (n,) True for prismatic joints.
    """

    rotations: FloatArray
    origins: FloatArray
    lengths: FloatArray
    slides: BoolArray

    @classmethod
    def from_arm(cls, arm: Arm) -> CertificateChain:
        """Build the chain of an arm, with frames rotated so that every axis is z, and with the base in the first frame."""
        joint_frames, from_links = align_joint_frames(arm)
        frames = np.concatenate([joint_frames, [from_links[-1] @ arm.tool]])
        rotations, origins = frames[:, :3, :3], frames[:, :3, 3]
        return cls(rotations, origins, link_lengths(rotations, list(origins[1:]), arm.prismatic), arm.prismatic)

    def closest_points_on_axes(self, joint: int) -> tuple[float, float] | None:
        """Return the heights, m, on the axes of a joint and the next one at which they are closest; None if parallel."""
        direction, origin = self.rotations[joint + 1][:, 2], self.origins[joint + 1]
        squared_sine = direction[:2] @ direction[:2]
        if squared_sine < 1e-12:
            return None
        height = -(origin[:2] @ direction[:2]) / squared_sine
        return float(origin[2] + height * direction[2]), float(height)


def link_lengths(rotations: FloatArray, links: Sequence[FloatArray], slides: BoolArray) -> FloatArray:
    """Return the lengths (k,), m, that each of some joints and the joints before it rotate, but the next joint does not.

    Args:
        rotations: (k or more, 3, 3) rotation of each joint's frame in the previous frame.
        links: (k, 3) vectors from each joint to the next one, and from the last one to the point behind it, m.
        slides: (k,) True for prismatic joints.
    """
    lengths = []
    for index in range(len(slides)):
        extent = links[index] * np.array([1, 1, slides[index]])
        if index + 1 < len(slides) and not slides[index + 1]:
            extent = extent + rotations[index + 1] @ [0, 0, links[index + 1][2]]
        lengths.append(float(np.linalg.norm(extent)))
    return np.array(lengths)


class ReachSolver:
    """Solver for configurations with the tool at a target, for a healthy arm or one with a locked joint.

    Args:
        arm: The arm.
        task: ``planar``, ``planar-pose``, ``position``, ``pointing`` or ``pose``.
        locked: Index of the locked joint; -1 for none.
        limits: (n, 2) joint limits, rad and m.
        rotation: (3, 3) rotation of the tool if the task includes it. None: the last coordinates of a target are roll, pitch
            and yaw, or in the plane yaw alone.
        angle: (2,) range in which the joint may lock, rad or m; not used for a revolute joint.

    Attributes:
        axes: Number of coordinates of a target: 2 or 3 positions, m, then roll, pitch and yaw, rad, if targets rotate.
        linear: Number of positions among them.
        slides: (n,) True for prismatic joints.
    """

    def __init__(
        self,
        arm: Arm,
        task: str,
        locked: int,
        limits: FloatArray,
        rotation: FloatArray | None = None,
        angle: FloatArray | None = None,
    ) -> None:
        self.arm, self.locked, self.limits, self.n = arm, locked, limits, arm.n
        locked_mask = np.arange(self.n) == locked
        self.fixed = ~locked_mask & (limits[:, 0] == limits[:, 1])
        self.free = ~locked_mask & ~self.fixed
        self.slides = arm.prismatic
        turning, chain = {"pose": 3, "planar-pose": 1}.get(task, 0) if rotation is None else 0, CertificateChain.from_arm(arm)
        # Heights do not matter in the plane.
        lengths = np.linalg.norm(chain.origins[1:, :2], axis=1) if task == "planar-pose" else chain.lengths
        self.expansion = ToolExpansion(arm, task, turning, np.asarray(lengths), self.slides)
        self.m, self.uses_rotation = self.expansion.m, self.expansion.uses_rotation
        self.axes, self.linear = self.expansion.axes, self.expansion.linear
        self._rotation = np.empty(0) if rotation is None else np.asarray(rotation).ravel()
        self._free, self._locked_mask = self.free.astype(float), locked_mask.astype(float)
        slide_extent = 0.0 if angle is None else float(np.abs(angle).max())
        self._slide_extent = self.slides * locked_mask * slide_extent
        self._limits = np.clip(limits.T, -_NO_LIMIT, _NO_LIMIT)

    @property
    def max_lock_displacement_rate(self) -> float:
        """Largest displacement of the tool, m, for each rad or m of the locked joint."""
        if self.slides[self.locked]:
            return 1.0
        return float(self.expansion.lengths.sum() + np.abs(self.sampling_limits[self.slides]).max(axis=1).sum())

    @property
    def sampling_limits(self) -> FloatArray:
        """(n, 2) limits, rad and m, with default sampling ranges for joints without limits."""
        range_limits = np.where(self.slides, _MAX_SLIDE_M, np.pi)[:, None]
        return np.clip(self.limits, -range_limits, range_limits)

    @property
    def is_redundant(self) -> bool:
        """True if the joints can move while the tool stays in place."""
        return bool(self.free.sum() > self.m)

    def set_nonfree_joints(self, q: FloatArray, coordinates: FloatArray) -> FloatArray:
        """Return configurations (N, n) with the locked joint at its value in ``coordinates``, and fixed joints at their limits.

        ``coordinates`` (N, A) are targets and locked values.
        """
        q = np.where(self.fixed, self.limits[:, 0], q)
        if self.locked >= 0:
            q[:, self.locked] = coordinates[:, -1]
        return q

    def append_target_rotation(self, targets: FloatArray) -> FloatArray:
        """Return targets (N, axes) in the form of the kernels."""
        return np.concatenate([targets, np.tile(self._rotation, (len(targets), 1))], axis=1)

    def measure_pose_error(self, q: FloatArray, targets: FloatArray) -> FloatArray:
        """Return position errors, m, and orientation errors, rad, of the tool at q (N, n) for targets (N, axes), as (N, 2)."""
        return self.expansion.pose_error_kernel.rows(q, self.append_target_rotation(targets))

    def solve_inverse_kinematics(
        self, q: FloatArray, targets: FloatArray, rounds: int = 8, desired_error: FloatArray | None = None
    ) -> FloatArray:
        """Run Newton's method on the free joints from q (N, n) to targets (N, axes), or to an error (N, m), within limits."""
        target_error = np.zeros((len(q), self.m)) if desired_error is None else desired_error
        fixed_inputs = np.tile(np.concatenate([self._free, *self._limits]), (len(q), 1))
        parameters = np.concatenate([self.append_target_rotation(targets), target_error, fixed_inputs], axis=1)
        return self.expansion.newton_loop.run(q, parameters, 1e-26, rounds).state

    def project_self_motion(self, q: FloatArray, moves: FloatArray) -> FloatArray:
        """Return the part of moves (N, n) at q (N, n) that keeps the tool in place, to first order."""
        return self.expansion.self_motion_kernel.rows(q, moves, self._free)


@dataclass(frozen=True, eq=False)
class TaylorForm:
    """Taylor forms at N configurations.

    Attributes:
        reach: Solver of the forms.
        q: (N, n) centers, rad.
        coefficients: (N, p) coefficients of :class:`holdfast.certificates.expansions.ToolExpansion`; NaN for a singular arm.
    """

    reach: ReachSolver
    q: FloatArray
    coefficients: FloatArray

    @classmethod
    def expand_at(cls, reach: ReachSolver, q: FloatArray, targets: FloatArray) -> TaylorForm:
        """Build the forms around q (N, n) for targets (N, axes) in the middle of their cells."""
        inputs = q, reach.append_target_rotation(targets), reach._free, reach._locked_mask, reach._slide_extent
        return cls(reach, q, reach.expansion.taylor_form_kernel.rows(*inputs))

    @property
    def error(self) -> FloatArray:
        """(N, m) error of the tool at the centers, in m, and as the axial part of rotations."""
        return self.coefficients[:, : self.reach.m]

    def select(self, rows: NDArray[np.intp] | BoolArray) -> TaylorForm:
        """Return the forms of some rows."""
        return TaylorForm(self.reach, self.q[rows], self.coefficients[rows])

    def bound_error_and_travel(
        self, cell_half_widths: FloatArray, section_half_widths: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Bound the error minus s above and below 0, (N, m) each, and the joint travel (N, n) for cells and sections."""
        upper_error, lower_error, joint_travel = self.reach.expansion.error_bound_kernel(
            self.coefficients, self._append_zero_lock_width(cell_half_widths), section_half_widths
        )
        return upper_error, lower_error, joint_travel

    def _append_zero_lock_width(self, cell_half_widths: FloatArray) -> FloatArray:
        """Return the cells with a lock axis of width 0 added for a healthy arm."""
        return np.pad(cell_half_widths, ((0, 0), (0, self.reach.axes + 1 - cell_half_widths.shape[1])))

    def is_cell_proved(self, cell_half_widths: FloatArray) -> BoolArray:
        """Return a mask of the cells, of half widths (N, c), that the forms prove."""
        initial_state = np.array([CELL_WIDTH_PARTS - 1.0, CELL_WIDTH_PARTS, 1])
        return np.asarray(self._count_provable_sixteenths(cell_half_widths, initial_state) == CELL_WIDTH_PARTS)

    def find_provable_width_fraction(self, cell_half_widths: FloatArray, minimum: FloatArray | None = None) -> FloatArray:
        """Return the largest factors (N,) below 1 by which cells of half widths (N, c) are proved, to 1/16.

        A factor of at most ``minimum`` (N,) is reported as the minimum, after a single test.
        """
        initial_state = np.array([0, CELL_WIDTH_PARTS / 2, CELL_WIDTH_PARTS / 2])
        if minimum is not None:  # no test passes for cells smaller than its margins
            passed = CELL_WIDTH_PARTS * minimum[:, None]
            increment = 2 ** np.ceil(np.log2(np.maximum(CELL_WIDTH_PARTS - 1 - passed, 1)))
            state = np.hstack([passed, passed + 1, np.where(passed + 1 < CELL_WIDTH_PARTS, increment, 0)])
            initial_state = np.where(passed == 0, initial_state, state)
        return self._count_provable_sixteenths(cell_half_widths, initial_state) / CELL_WIDTH_PARTS

    def _count_provable_sixteenths(self, cell_half_widths: FloatArray, initial_state: FloatArray) -> FloatArray:
        """Return the number (N,) of sixteenths of the cells' widths that pass the test.

        ``initial_state`` contains the number known to pass, the first tested number, and a power of 2, twice the next step.
        """
        reach, (lower, upper) = self.reach, self.reach._limits
        margins = np.where(reach.free, np.minimum(self.q - lower, upper - self.q), _NO_LIMIT)
        parameters = np.concatenate([self.coefficients, self._append_zero_lock_width(cell_half_widths), margins], axis=1)
        state = np.zeros((len(self.q), reach.m + 4))
        state[:, reach.m : reach.m + 3] = initial_state
        final_state = reach.expansion.cell_test_loop.run(state, parameters, 0.5, _MAX_TEST_STEPS).state
        return np.nan_to_num(final_state[:, reach.m])

    def choose_split_axis(self, cell_half_widths: FloatArray, allowed: BoolArray) -> IndexArray:
        """Return the axis (N,) among the ``allowed`` ones (N, c) whose halving leaves the smallest error and limit excess."""
        reach, (lower, upper) = self.reach, self.reach.limits.T
        costs = np.full(cell_half_widths.shape, np.inf)
        for axis in np.flatnonzero(allowed.any(axis=0)):
            halved_cells = cell_half_widths.copy()
            halved_cells[:, axis] /= 2
            upper_error, lower_error, _ = self.bound_error_and_travel(halved_cells, np.zeros((len(cell_half_widths), reach.m)))
            error = np.nan_to_num(np.maximum(upper_error, lower_error), nan=_SINGULAR_ERROR)
            _, _, joint_travel = self.bound_error_and_travel(halved_cells, np.maximum(error, 0))
            excess = np.maximum(lower - (self.q - joint_travel), self.q + joint_travel - upper)
            limit_excess = np.maximum(excess, 0) * reach.free
            costs[:, axis] = np.where(allowed[:, axis], error.sum(axis=1) + limit_excess.sum(axis=1), np.inf)
        return np.asarray(np.where(np.isfinite(costs).any(axis=1), costs.argmin(axis=1), 0), dtype=np.int64)
