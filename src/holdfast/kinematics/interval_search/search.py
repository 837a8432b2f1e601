"""Branch and bound over boxes of joints."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.progress import report_work, reports_progress
from holdfast.core.result import Result
from holdfast.core.status import SentenceEnum
from holdfast.core.typing import BoolArray, FloatArray
from holdfast.core.validation import check_arguments
from holdfast.kinematics.interval_search.box_bounds import ROUNDING_M_RAD
from holdfast.kinematics.interval_search.boxes import Blocked, BoxContractor, ContractedBoxes
from holdfast.model.arm.configurations import sampling_limits
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task, target_pose

MIN_BOX_SIZE = 1e-6  # rad and m: a box no wider than this is not bisected any more
_MAX_SMALL_BOXES = 20_000  # undecided boxes of the smallest size, as around singular configurations
_POLISHING_STEPS = 30
_FIRST_REFINED_BOXES = 2_000  # checked boxes before solutions are first refined from large boxes, then after each doubling
_REFINED_BOXES = 64  # large boxes from which solutions are then refined
_ISOLATION_SIZE = 1e-3  # rad and m: a provable solution in a box with smaller half widths counts as one configuration
_LOOSE_TOLERANCE = 1e-4  # m and rad: an allowed error above this fills boxes of the smallest size
_SOLUTION_TOLERANCE = 1e-5  # rad and m: closer solutions are the same one


class SearchOutcome(SentenceEnum):
    """Outcome of a search for configurations."""

    NONE = 0, "there is no configuration, proved up to floating point"
    ALL = 1, "these are all configurations, proved up to floating point"
    SOME = 2, "there are configurations; whether there are others was not asked"
    OPEN = 3, "undecided: time or boxes were spent first"


@dataclass(frozen=True, kw_only=True)
class Configurations(Result):
    """Configurations and outcome of :func:`all_configurations`.

    Attributes:
        arm: Arm model.
        task: Task whose rows are met.
        pose: (4, 4) pose of the end effector, m.
        lower, upper: (n,) limits of the search, rad and m; equal for a locked joint.
        finding: Outcome of the search.
        q: (K, n) configurations found, rad and m.
        boxes: Number of checked boxes.
        blocked: Number of boxes left out as blocked; claims of absence do not cover these boxes.
        open: Number of undecided boxes.
        widest: Largest half width of a joint in the undecided boxes, rad or m; 0 if none is left.
        seconds: Measured duration, s.
    """

    arm: Arm
    task: Task
    pose: FloatArray
    lower: FloatArray
    upper: FloatArray
    finding: SearchOutcome
    q: FloatArray
    boxes: int
    open: int
    widest: float
    seconds: float
    blocked: int = 0

    @property
    def proved_empty(self) -> bool:
        """True if it is proved that there is no configuration."""
        return self.finding == SearchOutcome.NONE


@check_arguments
@reports_progress("looking for every configuration")
def all_configurations(
    arm: Arm,
    pose: ArrayLike,
    task: str | Task | Sequence[str] = "pose",
    *,
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    tolerance: float | tuple[float, float] = 0.0,
    time_limit: float = 10.0,
    most_boxes: int = 20_000_000,
    first: bool = False,
    blocked: Blocked | None = None,
) -> Configurations:
    """Find every configuration of a pose within limits, or prove that there is none.

    Boxes of joint values are contracted to the part that can contain solutions and bisected, until only boxes around
    configurations remain. The search needs no start, sample or closed form, and claims of absence are proofs. If more joints
    move than the task has rows, the configurations are not isolated, and one of them ends the search. A last joint that moves
    no row of the task, such as one along a pointing tool, stays in the middle of its limits.

    Args:
        arm: Arm model.
        pose: (4, 4) pose of the end effector in the world, m; for a task without orientation also the rows of its position.
        task: ``pose``, ``pointing``, ``position``, ``planar``, ``planar-pose``, or position rows in the world frame.
        limits: (n,) lower and (n,) upper limits, rad and m; equal for a locked joint, as ``lo`` and ``hi`` of
            :class:`holdfast.Degraded`. Default: the arm's limits; joints without limits cover one turn.
        tolerance: Allowed error of each row, m and rad, or one number for both; the proof covers all poses within it.
        time_limit: Time limit, s; the outcome is then ``OPEN``.
        most_boxes: Maximum number of boxes; the outcome is then ``OPEN``.
        first: Stop at the first configuration.
        blocked: Function of boxes, centres (N, n) and half widths (N, n), that returns which of them (N,) contain no relevant
            configuration, for example because the arm certainly collides; these boxes are left out.

    Raises:
        InputError: The pose, the limits or a number is invalid.
        TaskError: No bounds exist for the task, or the pose is tilted out of the plane of a planar arm.

    Source: interval Newton methods (Krawczyk 1969); the bounds are ours, derived in
        ``holdfast/kinematics/interval_search/box_bounds.py``.
    """
    resolved_task = as_task(arm, task)
    requested_pose = target_pose(resolved_task, pose)
    lower, upper = _read_limits(arm, limits)
    allowed = np.broadcast_to(tolerance, 2)
    if not ((allowed >= 0).all() and np.isfinite(allowed).all()) or not time_limit > 0 or most_boxes < 1:
        raise InputError(
            f"tolerance is {tolerance}, time_limit {time_limit:g} and most_boxes {most_boxes}; give a finite tolerance of 0 or "
            "more, a time above 0 and 1 box or more"
        )
    contractor = BoxContractor(
        arm,
        resolved_task,
        requested_pose,
        tolerance=(float(allowed[0]), float(allowed[1])),
        limits=(lower, upper),
        blocked=blocked,
    )
    search = _BoxSearch(contractor)
    start_time = time.perf_counter()
    finding = search.run(start_time + time_limit, most_boxes, first)
    return Configurations(
        arm=arm,
        task=resolved_task,
        pose=requested_pose,
        lower=lower,
        upper=upper,
        finding=finding,
        q=search.solutions,
        boxes=contractor.checked,
        open=len(search.open_boxes),
        widest=float(search.open_boxes[:, 1].max(initial=0.0)),
        seconds=time.perf_counter() - start_time,
        blocked=contractor.blocked_count,
    )


def _read_limits(arm: Arm, limits: tuple[ArrayLike, ArrayLike] | None) -> tuple[FloatArray, FloatArray]:
    arm_limits = sampling_limits(arm)
    if limits is None:
        return arm_limits
    bounds = [np.asarray(bound, dtype=np.float64) for bound in limits]
    if len(bounds) != 2 or any(bound.shape != (arm.n,) or np.isnan(bound).any() for bound in bounds):
        raise InputError(f"limits must be two arrays of {arm.n} numbers, lower and upper, without NaN")
    lower, upper = (np.where(np.isfinite(bound), bound, arm_limit) for bound, arm_limit in zip(bounds, arm_limits, strict=True))
    inverted = np.flatnonzero(lower > upper)
    if inverted.size:
        raise InputError(
            f"limits of joint '{arm.joint_names[inverted[0]]}' are upside down: {lower[inverted[0]]:g} to "
            f"{upper[inverted[0]]:g}"
        )
    return lower, upper


class _BoxSearch:
    """Search over a stack of boxes that checks the last boxes first."""

    def __init__(self, boxes: BoxContractor) -> None:
        self._boxes, self._n = boxes, len(boxes.low)
        self._low, self._high, self._free = boxes.low, boxes.high, boxes.high > boxes.low
        self._is_square = int(self._free.sum()) == boxes.parts.m
        self._is_redundant = int(self._free.sum()) > boxes.parts.m
        self._has_loose_tolerance = bool(boxes.kernel_inputs[2].max() > _LOOSE_TOLERANCE)
        self._stack = [np.stack([(self._low + self._high) / 2, (self._high - self._low) / 2])[None]]
        self._small_boxes: list[FloatArray] = []  # boxes of the smallest size, (K, 2, n)
        self.solutions = np.zeros((0, self._n))

    @property
    def open_boxes(self) -> FloatArray:
        """Centers and half widths (K, 2, n) of the undecided boxes."""
        return np.concatenate([*self._stack, *self._small_boxes, np.zeros((0, 2, self._n))])

    def run(self, deadline: float, max_boxes: int, first: bool) -> SearchOutcome:
        """Search until all boxes are decided or a limit is reached."""
        stops_at_first, contractor, next_refinement = first or self._is_redundant, self._boxes, _FIRST_REFINED_BOXES
        with report_work("halving boxes of joints") as advance:
            while self._stack:
                if time.perf_counter() > deadline or contractor.checked >= max_boxes:
                    return SearchOutcome.OPEN
                contracted = contractor.contract(contractor.pop_batch(self._stack))
                if stops_at_first and contractor.checked >= next_refinement:
                    next_refinement = 2 * contractor.checked
                    self._add_solution_from_centers(contracted.box[:, 0])
                self._process_boxes(contracted)
                advance(contractor.checked, max_boxes)
                if stops_at_first and len(self.solutions):
                    return SearchOutcome.SOME
                # With a loose tolerance, the outcome after all boxes of that size would be the same.
                if sum(map(len, self._small_boxes)) > (0 if self._has_loose_tolerance else _MAX_SMALL_BOXES):
                    return SearchOutcome.OPEN
        if self._small_boxes:
            return SearchOutcome.OPEN
        return SearchOutcome.ALL if len(self.solutions) else SearchOutcome.NONE

    def _process_boxes(self, contracted: ContractedBoxes) -> None:
        """Check contracted boxes again, bisect them, or set them aside."""
        if self._is_square:
            holds_solution = contracted.inside.copy()
            holds_solution[holds_solution] = contracted.original[holds_solution, 1].max(axis=1, initial=0.0) < _ISOLATION_SIZE
            if holds_solution.any():
                self._refine_solutions(contracted.box[holds_solution, 0], contracted.original[holds_solution])
                contracted = contracted[~holds_solution]
        contracted = self._boxes.drop_blocked(contracted)
        tiny = contracted.box[:, 1, int(self._free.argmax())] < MIN_BOX_SIZE  # one joint first: a maximum over all takes longer
        tiny[tiny] = contracted.box[tiny, 1].max(axis=1, initial=0.0) < MIN_BOX_SIZE
        if tiny.any():
            self._refine_solutions(contracted.box[tiny, 0], contracted.box[tiny])
            contracted = contracted[~tiny]
        halves = contracted.bisect()
        if len(halves):
            self._stack.append(halves)

    def _add_solution_from_centers(self, q: FloatArray) -> None:
        """Add one solution that is not blocked, found by Newton's method from the best centers q (N, n) of boxes, if any."""
        margins = self._boxes.kernel.rows(q, np.zeros_like(q), *self._boxes.kernel_inputs, first=1)[:, 0]
        refined, is_solution = self._apply_newton(q[np.argsort(margins, kind="stable")[:_REFINED_BOXES]])
        solutions = np.stack([refined[is_solution], np.zeros_like(refined[is_solution])], axis=1)
        self.solutions = np.concatenate([self.solutions, solutions[~self._boxes.are_blocked(solutions)][:1, 0]])

    def _refine_solutions(self, q: FloatArray, boxes: FloatArray) -> None:
        """Refine q (N, n) in boxes (N, 2, n) by Newton's method; a box without a solution stays open."""
        q, is_solution = self._apply_newton(q)
        is_solution &= (np.abs(q - boxes[:, 0]) <= boxes[:, 1] + MIN_BOX_SIZE).all(axis=1)
        for solution in q[is_solution]:
            if not len(self.solutions) or np.abs(self.solutions - solution).max(axis=1).min() > _SOLUTION_TOLERANCE:
                self.solutions = np.concatenate([self.solutions, solution[None]])
        if not is_solution.all():
            self._small_boxes.append(boxes[~is_solution])

    def _apply_newton(self, q: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Apply Newton's method to q (N, n) within the limits; also return (N,) True for configurations within tolerance."""
        start_half_width = np.where(self._free, max(1e-4, self._boxes.kernel_inputs[2].max()), 0.0)
        for _ in range(_POLISHING_STEPS if len(q) else 0):
            outputs = self._boxes.kernel.rows(q, np.broadcast_to(start_half_width, q.shape), *self._boxes.kernel_inputs)
            step = outputs[:, 2 * self._n + 4 : 3 * self._n + 4]
            q = np.clip(q + step, self._low, self._high)
            if np.abs(step).max() < 1e-13:
                break
        outputs = self._boxes.kernel.rows(q, np.zeros_like(q), *self._boxes.kernel_inputs)
        is_near = (np.abs(outputs[:, 3 * self._n + 4 :]) <= self._boxes.kernel_inputs[2] + ROUNDING_M_RAD).all(axis=1)
        return q, is_near & (outputs[:, 0] <= 0)  # orientation rows also vanish at half a turn, where the margin is above 0
