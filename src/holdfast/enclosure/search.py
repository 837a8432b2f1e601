"""Branch and bound over boxes of joints."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, target_pose
from holdfast.enclosure.box_bounds import ROUNDING
from holdfast.enclosure.boxes import Blocked, Boxes, Cut
from holdfast.errors import InputError
from holdfast.notice import says, working
from holdfast.result import Result

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
SMALLEST = 1e-6  # rad and m: a box no wider than this is not halved any more
_NEWTON = 30
_ALONE = 1e-3  # rad and m: half width of a box below which what it provably holds counts as one configuration
_LOOSE = 1e-4  # m and rad: what is met within more fills boxes that are as small as boxes get
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
    tolerance: float | tuple[float, float] = 0.0,
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
        tolerance: By which each row may be missed, m and rad, or one number for both: the proof is about all these.
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
    allowed = np.broadcast_to(tolerance, 2)
    if not ((allowed >= 0).all() and np.isfinite(allowed).all()) or not time_limit > 0 or most_boxes < 1:
        raise InputError(
            f"tolerance is {tolerance}, time_limit {time_limit:g} and most_boxes {most_boxes}; give a finite tolerance of 0 or "
            "more, a time above 0 and 1 box or more"
        )
    boxes = Boxes(arm, rows, wanted, tolerance=(float(allowed[0]), float(allowed[1])), limits=(low, high), blocked=blocked)
    search = _Search(boxes)
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
        boxes=boxes.looked_at,
        open=search.open,
        widest=search.widest,
        seconds=time.perf_counter() - begin,
        blocked=boxes.left_out,
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

    def __init__(self, boxes: Boxes) -> None:
        self._boxes, self._n = boxes, len(boxes.low)
        self._low, self._high, self._free = boxes.low, boxes.high, boxes.high > boxes.low
        self._square = int(self._free.sum()) == boxes.parts.m
        self._more = int(self._free.sum()) > boxes.parts.m
        self._loose = bool(boxes.given[2].max() > _LOOSE)
        self._stack = [np.stack([(self._low + self._high) / 2, (self._high - self._low) / 2])[None]]
        self._small: list[Array] = []  # boxes that are not halved any more, (K, 2, n)
        self.found = np.zeros((0, self._n))

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
        ends, boxes = first or self._more, self._boxes
        with working("halving boxes of joints") as advance:
            while self._stack:
                if time.perf_counter() > until or boxes.looked_at >= most:
                    return Finding.OPEN
                self._look(boxes.cut(boxes.taken(self._stack)))
                advance(boxes.looked_at, most)
                if ends and len(self.found):
                    return Finding.SOME
                if self._small and self._loose:
                    return Finding.OPEN  # as it would be in the end, after all boxes of that size
        if self._small:
            return Finding.OPEN
        return Finding.ALL if len(self.found) else Finding.NONE

    def _look(self, cut: Cut) -> None:
        """What boxes can hold is looked at again, halved, or set aside."""
        if self._square:
            held = cut.inside & (cut.before[:, 1].max(axis=1, initial=0.0) < _ALONE)
            if held.any():
                self._polish(cut.box[held, 0], cut.before[held])
                cut = cut[~held]
        cut = self._boxes.clear(cut)
        tiny = cut.box[:, 1].max(axis=1, initial=0.0) < SMALLEST
        if tiny.any():
            self._polish(cut.box[tiny, 0], cut.box[tiny])
            cut = cut[~tiny]
        more = cut.halved()
        if len(more):
            self._stack.append(more)

    def _polish(self, q: Array, boxes: Array) -> None:
        """Newton's method from q (N, n) in boxes (N, 2, n): where it finds nothing there, the box stays open."""
        near = np.where(self._free, 1e-4, 0.0)
        for _ in range(_NEWTON):
            out = self._boxes.kernel.rows(q, np.broadcast_to(near, q.shape), *self._boxes.given)
            step = out[:, 2 * self._n + 4 : 3 * self._n + 4]
            q = np.clip(q + step, self._low, self._high)
            if np.abs(step).max() < 1e-13:
                break
        errors = self._boxes.kernel.rows(q, np.zeros_like(q), *self._boxes.given)[:, 3 * self._n + 4 :]
        met = (np.abs(errors) <= self._boxes.given[2] + ROUNDING).all(axis=1)
        there = (np.abs(q - boxes[:, 0]) <= boxes[:, 1] + SMALLEST).all(axis=1)
        good = there & met
        for x in q[good]:
            if not len(self.found) or np.abs(self.found - x).max(axis=1).min() > _SAME:
                self.found = np.concatenate([self.found, x[None]])
        if not good.all():
            self._small.append(boxes[~good])
