"""Batches of joint boxes, which are contracted to the part that can contain solutions and then bisected."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from holdfast.core.errors import TaskError
from holdfast.core.typing import BoolArray, FloatArray, IndexArray
from holdfast.kernels.kernel import Kernel
from holdfast.kinematics.interval_search.box_bounds import BoundedTask, box_contraction_kernel, is_last_joint_idle
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task

Blocked = Callable[[FloatArray, FloatArray], BoolArray]
"""Function of centres (N, n) and half widths (N, n) that returns which boxes (N,) contain no relevant configuration."""

_BATCH_ROWS = 4096  # boxes checked together
_CONTRACTION_RATIO = 0.6  # a box that was contracted below this fraction of its volume is checked again before it is bisected
_MAX_TILT = 1e-6  # rad; its effect on the bounds is its square


@dataclass(frozen=True, eq=False)
class ContractedBoxes:
    """Non-empty boxes, contracted to the part that can contain solutions.

    Attributes:
        box: (N, 2, n) centres and half widths.
        original: (N, 2, n) boxes before the contraction.
        inside: (N,) True if the contracted box lies strictly inside the original.
        volume: (N,) remaining fraction of the volume.
        widest_joint: (N,) joint to be bisected.
    """

    box: FloatArray
    original: FloatArray
    inside: BoolArray
    volume: FloatArray
    widest_joint: IndexArray

    def __getitem__(self, selection: BoolArray) -> ContractedBoxes:
        return ContractedBoxes(
            self.box[selection],
            self.original[selection],
            self.inside[selection],
            self.volume[selection],
            self.widest_joint[selection],
        )

    def bisect(self) -> FloatArray:
        """Return the boxes (K, 2, n) to check next: strongly contracted ones unchanged, the others in two halves."""
        shrunk = self.volume < _CONTRACTION_RATIO
        first, count = int(shrunk.sum()), len(shrunk) - int(shrunk.sum())
        boxes = np.empty((first + 2 * count, *self.box.shape[1:]))
        lower, upper = boxes[first : first + count], boxes[first + count :]
        boxes[:first], lower[...] = self.box[shrunk], self.box[~shrunk]
        row, joint_index = np.arange(count), self.widest_joint[~shrunk]
        lower[row, 1, joint_index] /= 2
        upper[...] = lower
        lower[row, 0, joint_index] -= upper[row, 1, joint_index]
        upper[row, 0, joint_index] += upper[row, 1, joint_index]
        return boxes


class BoxContractor:
    """Contractor of boxes of an arm's joints, for a pose or along a straight leg that begins there.

    Args:
        arm: Arm model.
        task: Task whose rows are to be met.
        pose: (4, 4) pose of the end effector, world, m.
        tolerance: Allowed error of each row, m and rad, in any frame of the rows.
        limits: (n,) lower and (n,) upper joint limits, rad and m.
        blocked: Function that returns which boxes contain no relevant configuration.
        way: (3,) vector of the leg, m; the position on the leg, 0 to 1, is then the last joint.

    Attributes:
        parts: Rows of the task.
        kernel, kernel_inputs: Kernel that contracts boxes, and its inputs in addition to the boxes.
        lower, upper: (n,) limits of all boxes; a joint that moves no row is in the middle.
        checked, blocked_count: Number of boxes, and number of blocked ones.

    Raises:
        TaskError: No bounds exist for the task, or the pose is tilted out of the plane of a planar arm.
    """

    def __init__(
        self,
        arm: Arm,
        task: Task,
        pose: FloatArray,
        *,
        tolerance: tuple[float, float],
        limits: tuple[FloatArray, FloatArray],
        blocked: Blocked | None,
        way: FloatArray | None = None,
    ) -> None:
        lower, upper = limits[0].copy(), limits[1].copy()
        self.parts = parts = BoundedTask.from_task(arm, task)
        if parts.normal:  # bounds cover rotation in the plane only, but tilted poses meet the row of the task as well
            tilted_normal = pose[:3, :3] @ arm.forward_kinematics((lower + upper) / 2)[:3, :3].T @ parts.normal
            if np.abs(tilted_normal - parts.normal).max() > _MAX_TILT:
                raise TaskError(f"nothing can be proved about task '{task.name}': the pose is tilted out of the arm's plane")
        self.kernel: Kernel = box_contraction_kernel(arm, parts, way is not None)
        counts = len(parts.linear), parts.m - len(parts.linear)
        row_tolerances = np.repeat(np.sqrt(counts) * tolerance, counts)  # norms, which are the same in all frames
        self.kernel_inputs = (pose[:3, 3], pose[:3, :3], row_tolerances, *([] if way is None else [way]))
        self._n, self._blocked = arm.n, blocked
        self._idle_half_width = np.zeros(arm.n)  # half widths of a joint that is not searched but may block
        if is_last_joint_idle(arm, parts):
            self._idle_half_width[-1] = (upper[-1] - lower[-1]) / 2
            lower[-1] = upper[-1] = (lower[-1] + upper[-1]) / 2
        if way is not None:
            lower, upper = np.append(lower, 0.0), np.append(upper, 1.0)
        self.low, self.high = lower, upper
        self.checked = self.blocked_count = 0

    def pop_batch(self, stack: list[FloatArray]) -> FloatArray:
        """Remove the last boxes of a stack, up to the size of a batch, and return them."""
        boxes = stack.pop()
        while len(boxes) < _BATCH_ROWS and stack:
            boxes = np.concatenate([stack.pop(), boxes])
        if len(boxes) > _BATCH_ROWS:
            stack.append(boxes[:-_BATCH_ROWS])
        return boxes[-_BATCH_ROWS:]

    def contract(self, boxes: FloatArray) -> ContractedBoxes:
        """Contract boxes (N, 2, n) and drop the empty ones."""
        self.checked += len(boxes)
        n = boxes.shape[2]
        outputs = self.kernel.rows(boxes[:, 0], boxes[:, 1], *self.kernel_inputs, first=2 * n + 4)
        nonempty = np.flatnonzero(outputs[:, 0] <= 0)
        outputs = outputs[nonempty]
        return ContractedBoxes(
            outputs[:, 1:-3].reshape(-1, 2, n),
            boxes[nonempty],
            outputs[:, -3] < 0,
            outputs[:, -2],
            outputs[:, -1].astype(np.intp),
        )

    def are_blocked(self, boxes: FloatArray) -> BoolArray:
        """Return (N,) True for the blocked ones of boxes (N, 2, n)."""
        if self._blocked is None or not len(boxes):
            return np.zeros(len(boxes), dtype=bool)
        return self._blocked(boxes[:, 0, : self._n], boxes[:, 1, : self._n] + self._idle_half_width)

    def drop_blocked(self, contracted: ContractedBoxes) -> ContractedBoxes:
        """Drop the boxes that are blocked."""
        is_free = ~self.are_blocked(contracted.box)
        self.blocked_count += len(is_free) - int(is_free.sum())
        return contracted if is_free.all() else contracted[is_free]
