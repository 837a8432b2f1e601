"""Branch and bound over boxes of joints."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, target_pose
from holdfast.enclosure.box_bounds import ROUNDING, Parts, box_kernel, idle
from holdfast.errors import InputError, TaskError
from holdfast.kernels.kernel import Kernel
from holdfast.notice import says, working
from holdfast.result import Result

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Blocked = Callable[[Array, Array], Flags]
"""Which boxes, with centres (N, n) and half widths (N, n), hold nothing that counts."""

SMALLEST = 1e-6  # rad and m: a box no wider than this is not halved any more
_BATCH = 4096  # boxes looked at together
_GAIN = 0.6  # of its volume: a box that was cut to less is looked at again before it is halved
_NEWTON = 30
_ALONE = 1e-3  # rad and m: half width of a box below which what it provably holds counts as one configuration
_TILT = 1e-6  # what it does to the bounds is its square
_SAME = 1e-5  # rad and m: solutions nearer than this are one


class Finding(IntEnum):
    """What is known in the end."""

    NONE = 0
    ALL = 1
    SOME = 2
    OPEN = 3

    @property
    def sentence(self) -> str:
        """What it means."""
        return _SENTENCES[self]


_SENTENCES = {
    Finding.NONE: "there is no configuration, proved up to floating point",
    Finding.ALL: "these are all configurations, proved up to floating point",
    Finding.SOME: "there are configurations; whether there are others was not asked",
    Finding.OPEN: "undecided: time or boxes were spent first",
}


@dataclass(frozen=True, kw_only=True)
class Configurations(Result):
    """What :func:`all_configurations` found.

    Attributes:
        arm: The arm.
        task: Whose rows are met.
        pose: (4, 4) of the end effector, m.
        lower, upper: (n,) limits that were looked into, rad and m; equal where a joint is locked.
        finding: What is known.
        q: (K, n) configurations found, rad and m.
        boxes: How many were looked at.
        blocked: Of these, how many were left out as blocked: what is said to be absent is absent elsewhere.
        open: How many were left undecided.
        widest: Of these, the largest half width of a joint, rad or m; 0 if none is left.
        seconds: Measured.
    """

    arm: Arm
    task: Task
    pose: Array
    lower: Array
    upper: Array
    finding: Finding
    q: Array
    boxes: int
    open: int
    widest: float
    seconds: float
    blocked: int = 0

    @property
    def none(self) -> bool:
        """Proved: there is no configuration."""
        return self.finding == Finding.NONE

    def describe(self) -> list[str]:
        """A sentence for people."""
        left = f", {self.open:,} of them left, up to {2 * self.widest:.2g} wide" if self.open else ""
        without = f", {self.blocked:,} of them blocked and left out" if self.blocked else ""
        return [
            f"{len(self.q)} configurations of '{self.arm.name}', task {self.task.name}: {self.finding.sentence}",
            f"{self.boxes:,} boxes of joints{without}{left}, {self.seconds:.2g} s",
        ]


@checked
@says("looking for every configuration")
def all_configurations(
    arm: Arm,
    pose: ArrayLike,
    task: str | Task | Sequence[str] = "pose",
    *,
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    tolerance: float = 0.0,
    time_limit: float = 10.0,
    most_boxes: int = 20_000_000,
    first: bool = False,
    blocked: Blocked | None = None,
) -> Configurations:
    """Every configuration of a pose within limits, or a proof that there is none.

    Boxes of joints are cut to what they can hold and halved until none is left but those around configurations. No start, no
    sample and no closed form is needed: what is said to be absent is absent. If more joints move than the task has rows, the
    configurations are no points, and one of them ends the search. A last joint that moves no row of the task, as one along a
    tool that points, is left in the middle of its limits.

    Args:
        arm: The arm.
        pose: (4, 4) of the end effector in the world, m; for a task without orientation also its rows of the position.
        task: ``pose``, ``pointing``, ``position``, ``planar``, ``planar-pose``, or position rows in the world frame.
        limits: (n,) lower and (n,) upper limits, rad and m; equal where a joint is locked, as ``lo`` and ``hi`` of
            :class:`holdfast.Degraded`. Default: the arm's; joints without limits turn once.
        tolerance: m and rad by which each row may be missed: the proof is about all these.
        time_limit: s after which the answer is ``OPEN``.
        most_boxes: After which it is.
        first: One configuration ends the search.
        blocked: Given boxes, centres (N, n) and half widths (N, n), says of which (N,) nothing counts, as where the arm
            certainly is within an object: these are left out.

    Raises:
        InputError: A pose, limits or numbers that are invalid.
        TaskError: A task about which nothing can be proved, or a pose tilted out of the plane of a planar arm.

    Source: interval Newton methods (Krawczyk 1969); the bounds are ours, derived in ``holdfast/enclosure/box_bounds.py``.
    """
    rows = as_task(arm, task)
    wanted = target_pose(rows, pose)
    low, high = _limits(arm, limits)
    if not (tolerance >= 0 and np.isfinite(tolerance)) or not time_limit > 0 or most_boxes < 1:
        raise InputError(
            f"tolerance is {tolerance:g}, time_limit {time_limit:g} and most_boxes {most_boxes}; give a finite tolerance of 0 "
            "or more, a time above 0 and 1 box or more"
        )
    search = _Search(arm, rows, wanted, tolerance, low, high, blocked)
    begin = time.perf_counter()
    finding = search.run(begin + time_limit, most_boxes, first)
    return Configurations(
        arm=arm,
        task=rows,
        pose=wanted,
        lower=low,
        upper=high,
        finding=finding,
        q=search.found,
        boxes=search.boxes,
        open=search.open,
        widest=search.widest,
        seconds=time.perf_counter() - begin,
        blocked=search.left_out,
    )


def _limits(arm: Arm, limits: tuple[ArrayLike, ArrayLike] | None) -> tuple[Array, Array]:
    whole = finite_limits(arm)
    if limits is None:
        return whole
    given = [np.asarray(x, dtype=np.float64) for x in limits]
    if len(given) != 2 or any(x.shape != (arm.n,) or np.isnan(x).any() for x in given):
        raise InputError(f"limits must be two arrays of {arm.n} numbers, lower and upper, without NaN")
    low, high = (np.where(np.isfinite(x), x, end) for x, end in zip(given, whole, strict=True))
    upside = np.flatnonzero(low > high)
    if upside.size:
        raise InputError(
            f"limits of joint '{arm.joint_names[upside[0]]}' are upside down: {low[upside[0]]:g} to {high[upside[0]]:g}"
        )
    return low, high


class _Search:
    """One search: a stack of boxes, the last of which are looked at first."""

    def __init__(
        self, arm: Arm, task: Task, pose: Array, tolerance: float, low: Array, high: Array, blocked: Blocked | None
    ) -> None:
        parts = Parts.of(arm, task)
        if parts.normal:  # bounds know a turn in the plane alone; the task's row is met by tilted poses too
            turned = pose[:3, :3] @ arm.forward_kinematics((low + high) / 2)[:3, :3].T @ parts.normal
            if np.abs(turned - parts.normal).max() > _TILT:
                raise TaskError(f"nothing can be proved about task '{task.name}': the pose is tilted out of the arm's plane")
        self._kernel: Kernel = box_kernel(arm, parts)
        self._given = pose[:3, 3], pose[:3, :3], np.full(parts.m, tolerance)
        self._unseen = np.zeros(arm.n)  # half widths of a joint that was not looked at all over, but may block
        if idle(arm, parts):
            self._unseen[-1] = (high[-1] - low[-1]) / 2
            low, high = low.copy(), high.copy()
            low[-1] = high[-1] = (low[-1] + high[-1]) / 2
        self._free = high > low
        self._square = int(self._free.sum()) == parts.m
        self._more = int(self._free.sum()) > parts.m
        self._low, self._high, self._n = low, high, arm.n
        self._stack = [np.stack([(low + high) / 2, (high - low) / 2])[None]]
        self._small: list[Array] = []  # boxes that are not halved any more, (K, 2, n)
        self.found = np.zeros((0, arm.n))
        self.boxes = self.left_out = 0
        self._blocked = blocked

    @property
    def _left(self) -> Array:
        return np.concatenate([*self._stack, *self._small, np.zeros((0, 2, self._n))])

    @property
    def open(self) -> int:
        """Boxes that are not decided."""
        return len(self._left)

    @property
    def widest(self) -> float:
        """Of these."""
        return float(self._left[:, 1].max(initial=0.0))

    def run(self, until: float, most: int, first: bool) -> Finding:
        """Look until all is decided, or no more may be done."""
        ends = first or self._more
        with working("halving boxes of joints") as advance:
            while self._stack:
                if time.perf_counter() > until or self.boxes >= most:
                    return Finding.OPEN
                self._look(self._take())
                advance(self.boxes, most)
                if ends and len(self.found):
                    return Finding.SOME
        if self._small:
            return Finding.OPEN
        return Finding.ALL if len(self.found) else Finding.NONE

    def _take(self) -> Array:
        boxes = self._stack.pop()
        while len(boxes) < _BATCH and self._stack:
            boxes = np.concatenate([self._stack.pop(), boxes])
        if len(boxes) > _BATCH:
            self._stack.append(boxes[:-_BATCH])
        return boxes[-_BATCH:]

    def _look(self, boxes: Array) -> None:
        """Cut boxes (N, 2, n) to what they can hold; what is left is looked at again, halved, or set aside."""
        self.boxes += len(boxes)
        n = self._n
        out = self._kernel.rows(boxes[:, 0], boxes[:, 1], *self._given, first=2 * n + 4)
        left = np.flatnonzero(out[:, 0] <= 0)
        cut, inside, volume, which = out[left, 1 : 2 * n + 1].reshape(-1, 2, n), *out[left, 2 * n + 1 :].T
        if self._square:
            held = (inside < 0) & (boxes[left, 1].max(axis=1) < _ALONE)
            if held.any():
                self._polish(cut[held, 0], boxes[left[held]])
                cut, volume, which = cut[~held], volume[~held], which[~held]
        if self._blocked is not None and len(cut):
            clear = ~self._blocked(cut[:, 0], cut[:, 1] + self._unseen)
            if not clear.all():
                self.left_out += len(clear) - int(clear.sum())
                cut, volume, which = cut[clear], volume[clear], which[clear]
        tiny = cut[:, 1].max(axis=1, initial=0.0) < SMALLEST
        if tiny.any():
            self._polish(cut[tiny, 0], cut[tiny])
            cut, volume, which = cut[~tiny], volume[~tiny], which[~tiny]
        again = volume < _GAIN
        halved = cut[~again]
        row, k = np.arange(len(halved)), which[~again].astype(np.intp)
        halved[row, 1, k] /= 2
        lower = halved.copy()
        lower[row, 0, k] -= halved[row, 1, k]
        halved[row, 0, k] += halved[row, 1, k]
        more = np.concatenate([cut[again], lower, halved])
        if len(more):
            self._stack.append(more)

    def _polish(self, q: Array, boxes: Array) -> None:
        """Newton's method from q (N, n) in boxes (N, 2, n): where it finds nothing there, the box stays open."""
        near = np.where(self._free, 1e-4, 0.0)
        for _ in range(_NEWTON):
            out = self._kernel.rows(q, np.broadcast_to(near, q.shape), *self._given)
            step = out[:, 2 * self._n + 4 : 3 * self._n + 4]
            q = np.clip(q + step, self._low, self._high)
            if np.abs(step).max() < 1e-13:
                break
        missed = np.abs(self._kernel.rows(q, np.zeros_like(q), *self._given)[:, 3 * self._n + 4 :]).max(axis=1)
        there = (np.abs(q - boxes[:, 0]) <= boxes[:, 1] + SMALLEST).all(axis=1)
        good = there & (missed <= self._given[2].max() + ROUNDING)
        for x in q[good]:
            if not len(self.found) or np.abs(self.found - x).max(axis=1).min() > _SAME:
                self.found = np.concatenate([self.found, x[None]])
        if not good.all():
            self._small.append(boxes[~good])
