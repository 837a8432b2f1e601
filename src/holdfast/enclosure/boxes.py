"""Boxes of joints: looked at many at a time, cut to what they can hold, halved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task
from holdfast.enclosure.box_bounds import Parts, box_kernel, idle
from holdfast.errors import TaskError
from holdfast.kernels.kernel import Kernel

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Blocked = Callable[[Array, Array], Flags]
"""Which boxes, with centres (N, n) and half widths (N, n), hold nothing that counts."""

_BATCH = 4096  # boxes looked at together
_GAIN = 0.6  # of its volume: a box that was cut to less is looked at again before it is halved
_TILT = 1e-6  # what it does to the bounds is its square


@dataclass(frozen=True, eq=False)
class Cut:
    """Boxes that are not empty, cut to what they can hold.

    Attributes:
        box: (N, 2, n) centres and half widths.
        before: (N, 2, n) as they were.
        inside: (N,) True where what a box can hold lies strictly inside of it.
        volume: (N,) how much of it that is.
        which: (N,) joint to be halved.
    """

    box: Array
    before: Array
    inside: Flags
    volume: Array
    which: NDArray[np.intp]

    def __getitem__(self, some: Flags) -> Cut:
        return Cut(self.box[some], self.before[some], self.inside[some], self.volume[some], self.which[some])

    def halved(self) -> Array:
        """(K, 2, n) what is to be looked at next."""
        again = self.volume < _GAIN
        upper = self.box[~again]
        row, k = np.arange(len(upper)), self.which[~again]
        upper[row, 1, k] /= 2
        lower = upper.copy()
        lower[row, 0, k] -= upper[row, 1, k]
        upper[row, 0, k] += upper[row, 1, k]
        return np.concatenate([self.box[again], lower, upper])


class Boxes:
    """What looks at boxes of an arm's joints, for a pose or along a straight way from it.

    Args:
        arm: The arm.
        task: Whose rows are to be met.
        pose: (4, 4) of the end effector, world, m.
        tolerance: m and rad by which each row may be missed, whatever the frame in which rows are taken.
        limits: (n,) and (n,) of the joints, rad and m.
        blocked: Which boxes hold nothing that counts.
        way: (3,) m; where on it the pose is, 0 to 1, is then the last of all joints.

    Attributes:
        parts: The task's rows.
        kernel, given: What tells of boxes, and what it is given beside them.
        low, high: (n,) of all boxes; a joint that moves no row is in the middle.
        looked_at, left_out: How many boxes, and how many of them as blocked.

    Raises:
        TaskError: A task about which nothing can be proved, or a pose tilted out of the plane of a planar arm.
    """

    def __init__(
        self,
        arm: Arm,
        task: Task,
        pose: Array,
        *,
        tolerance: tuple[float, float],
        limits: tuple[Array, Array],
        blocked: Blocked | None,
        way: Array | None = None,
    ) -> None:
        low, high = limits[0].copy(), limits[1].copy()
        self.parts = parts = Parts.of(arm, task)
        if parts.normal:  # bounds know a turn in the plane alone; the task's row is met by tilted poses too
            turned = pose[:3, :3] @ arm.forward_kinematics((low + high) / 2)[:3, :3].T @ parts.normal
            if np.abs(turned - parts.normal).max() > _TILT:
                raise TaskError(f"nothing can be proved about task '{task.name}': the pose is tilted out of the arm's plane")
        self.kernel: Kernel = box_kernel(arm, parts, way is not None)
        counts = len(parts.linear), parts.m - len(parts.linear)
        missed = np.repeat(np.sqrt(np.maximum(counts, 1)) * tolerance, counts)  # rows of other frames miss by no more
        self.given = (pose[:3, 3], pose[:3, :3], missed, *([] if way is None else [way]))
        self._n, self._blocked = arm.n, blocked
        self._unseen = np.zeros(arm.n)  # half widths of a joint that was not looked at all over, but may block
        if idle(arm, parts):
            self._unseen[-1] = (high[-1] - low[-1]) / 2
            low[-1] = high[-1] = (low[-1] + high[-1]) / 2
        if way is not None:
            low, high = np.append(low, 0.0), np.append(high, 1.0)
        self.low, self.high = low, high
        self.looked_at = self.left_out = 0

    def taken(self, stack: list[Array]) -> Array:
        """The last boxes of a stack, as many as are looked at together."""
        boxes = stack.pop()
        while len(boxes) < _BATCH and stack:
            boxes = np.concatenate([stack.pop(), boxes])
        if len(boxes) > _BATCH:
            stack.append(boxes[:-_BATCH])
        return boxes[-_BATCH:]

    def cut(self, boxes: Array) -> Cut:
        """What boxes (N, 2, n) can hold, without those that are empty."""
        self.looked_at += len(boxes)
        n = boxes.shape[2]
        out = self.kernel.rows(boxes[:, 0], boxes[:, 1], *self.given, first=2 * n + 4)
        left = np.flatnonzero(out[:, 0] <= 0)
        out = out[left]
        return Cut(out[:, 1:-3].reshape(-1, 2, n), boxes[left], out[:, -3] < 0, out[:, -2], out[:, -1].astype(np.intp))

    def clear(self, cut: Cut) -> Cut:
        """Without those that are blocked."""
        if self._blocked is None or not len(cut.box):
            return cut
        clear = ~self._blocked(cut.box[:, 0, : self._n], cut.box[:, 1, : self._n] + self._unseen)
        self.left_out += len(clear) - int(clear.sum())
        return cut if clear.all() else cut[clear]
