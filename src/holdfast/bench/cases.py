"""Cases of the suite: a failure, where the arm is, and what it must do, all of them from one seed.

The suite is rebuilt from what is public of DEFT (arXiv 2602.02895): its own sampling, tolerances and split could not be read.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, rows_task
from holdfast.clearance.clearance import Clearance
from holdfast.errors import InputError
from holdfast.failures import Degraded
from holdfast.keep.kept import Kept, upright
from holdfast.paths.path import Path, line, sequence
from holdfast.recovery.rows import row_solver

Array = NDArray[np.float64]
Rng = np.random.Generator

_DRAWS = 4000  # configurations drawn before a case counts as impossible to draw
_LANES, _LANE, _APART = 3, 0.2, 0.04  # of wiping: lanes, and m of each and between two
_LEANS = np.deg2rad(2)  # by which the tool may lean where it is kept upright
_KINDS = ("lock", "range", "speed")
_OFTEN = (0.5, 0.3, 0.2)  # how often each is drawn


@dataclass(frozen=True, eq=False)
class Case:
    """One case.

    Attributes:
        task: Its name, a key of ``TASKS``.
        degraded: What has failed.
        at: (n,) where the arm is, rad and m: within what is left, and clear.
        rows: Of the end effector's pose that matter.
        goal: (4, 4) pose to be reached, world, m; None if a path is to be followed.
        path: To be followed; None if a pose is to be reached.
        keep: What must be kept along the whole motion.
    """

    task: str
    degraded: Degraded
    at: Array
    _: KW_ONLY
    rows: Task
    goal: Array | None = None
    path: Path | None = None
    keep: tuple[Kept, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """As JSON data: everything that defines it."""
        d = self.degraded
        corners = None if self.path is None else self.path.pose(self.path.bounds).tolist()
        return {
            "task": self.task,
            "locked": dict(d.locked),
            "range": {name: list(limits) for name, limits in d.ranges.items()},
            "speed": dict(d.speeds),
            "at": self.at.tolist(),
            "rows": self.rows.to_dict(),
            "goal": None if self.goal is None else self.goal.tolist(),
            "path": corners,
            **({"keep": [kept.to_dict() for kept in self.keep]} if self.keep else {}),
        }


def draw_failure(arm: Arm, most: int, rng: Rng) -> Degraded:
    """One to ``most`` joints, each locked, with a part of its range, or slower.

    The number is uniform; of each joint a lock, a range, a speed with probability 0.5, 0.3, 0.2. A lock is uniform within the
    limits, a range a fraction from 0.1 to 0.7 of them anywhere, a speed a fraction from 0.1 to 0.5.
    """
    low, high = finite_limits(arm)
    found: dict[str, dict[str, Any]] = {kind: {} for kind in _KINDS}
    for k in rng.choice(arm.n, size=rng.integers(1, most + 1), replace=False):
        kind = _KINDS[rng.choice(len(_KINDS), p=_OFTEN)]
        width = (high[k] - low[k]) * rng.uniform(0.1, 0.7)
        begin = rng.uniform(low[k], high[k] - width)
        values = {"lock": rng.uniform(low[k], high[k]), "range": (begin, begin + width), "speed": rng.uniform(0.1, 0.5)}
        found[kind][arm.joint_names[k]] = values[kind]
    return Degraded(arm, locked=found["lock"], ranges=found["range"], speeds=found["speed"])


class Draw:
    """Draws cases of an arm, with what must be kept clear."""

    def __init__(self, arm: Arm, clearance: Clearance | None) -> None:
        self.arm, self.clearance = arm, clearance
        self._down = row_solver(arm, rows_task(["wx", "wy"], frame="tool"))

    def case(self, task: str, rng: Rng) -> Case:
        """A case of a task.

        Raises:
            InputError: No such task, or no case of it was found.
        """
        if task not in TASKS:
            raise InputError(f"task '{task}' of the suite is not known; use {', '.join(TASKS)}")
        return TASKS[task](self, task, rng)

    # ---- configurations ----------------------------------------------------------------------------------------------

    def clear(self, q: Array) -> NDArray[np.bool_]:
        """(N,) True where configurations (N, n) keep away from everything."""
        if self.clearance is None:
            return np.ones(len(q), dtype=bool)
        return np.asarray(self.clearance.room(q) >= 0)

    def anywhere(self, low: Array, high: Array, rng: Rng) -> Array:
        """A clear configuration (n,), uniform between the limits (n,) each."""
        for _ in range(_DRAWS // 40):
            q = rng.uniform(low, high, (40, self.arm.n))
            good = np.flatnonzero(self.clear(q))
            if good.size:
                return np.asarray(q[good[0]])
        raise NothingDrawn

    def pointing_down(self, low: Array, high: Array, rng: Rng) -> Array:
        """The same, its tool's z axis straight down."""
        free = high > low
        down = np.diag([1.0, -1.0, -1.0, 1.0])
        for _ in range(_DRAWS // 40):
            q = rng.uniform(low, high, (40, self.arm.n))
            poses = np.tile(down, (len(q), 1, 1))
            kept = np.ones((len(q), 2))
            q = self._down.run(q, poses, kept, free)
            inside = ((q >= low) & (q <= high) | ~free).all(axis=1)
            good = np.flatnonzero(inside & self._down.meets(q, poses, kept, free) & self.clear(q))
            if good.size:
                return np.asarray(q[good[0]])
        raise NothingDrawn


class NothingDrawn(Exception):
    """No configuration was found for a failure: another one is drawn."""


def _limits(degraded: Degraded) -> tuple[Array, Array]:
    """Finite limits in force."""
    low, high = finite_limits(degraded.limited)
    moves = degraded.moves
    return np.where(moves, low, degraded.lo), np.where(moves, high, degraded.hi)


def _again(make: Callable[[Draw, str, Rng], Case]) -> Callable[[Draw, str, Rng], Case]:
    """With other failures until one allows a case."""

    def made(draw: Draw, task: str, rng: Rng) -> Case:
        for _ in range(100):
            try:
                return make(draw, task, rng)
            except NothingDrawn:
                continue
        raise InputError(f"no case of '{task}' could be drawn for '{draw.arm.name}': hardly any configuration of it is clear")

    return made


# ---- tasks ---------------------------------------------------------------------------------------------------------------


@_again
def _reach(draw: Draw, task: str, rng: Rng) -> Case:
    """A goal that a clear configuration has: of the degraded arm, or of the healthy one."""
    arm, degraded = draw.arm, draw_failure(draw.arm, 3, rng)
    limits = _limits(degraded)
    at = draw.anywhere(*limits, rng)
    there = draw.anywhere(*(finite_limits(arm) if "healthy" in task else limits), rng)
    return Case(task, degraded, at, rows=as_task(arm, task.rpartition("-")[2]), goal=arm.forward_kinematics(there))


@_again
def _line(draw: Draw, task: str, rng: Rng) -> Case:
    """0.3 m in a random direction, the orientation kept; or 0.25 m back along the tool, as of a drawer."""
    degraded = draw_failure(draw.arm, 2, rng)
    at = draw.anywhere(*_limits(degraded), rng)
    here = draw.arm.forward_kinematics(at)
    way = rng.normal(size=3)
    way = -0.25 * here[:3, 2] if task == "drawer" else 0.3 * way / np.linalg.norm(way)
    return Case(task, degraded, at, rows=as_task(draw.arm, "pose"), path=line(here, _moved(here, way)))


@_again
def _wipe(draw: Draw, task: str, rng: Rng) -> Case:
    """Three lanes in the plane across the tool, whose axis stays normal to it; turning about that is free."""
    degraded = draw_failure(draw.arm, 2, rng)
    at = draw.anywhere(*_limits(degraded), rng)
    here = draw.arm.forward_kinematics(at)
    poses, x, y = [here], 0.0, 0.0
    for lane in range(_LANES):
        x = _LANE - x
        poses.append(_moved(here, x * here[:3, 0] + y * here[:3, 1]))
        if lane < _LANES - 1:
            y += _APART
            poses.append(_moved(here, x * here[:3, 0] + y * here[:3, 1]))
    return Case(task, degraded, at, rows=as_task(draw.arm, "pointing"), path=sequence(poses))


@_again
def _tray(draw: Draw, task: str, rng: Rng) -> Case:
    """0.3 m on the level, the tool straight down; turning about the vertical is free."""
    degraded = draw_failure(draw.arm, 2, rng)
    at = draw.pointing_down(*_limits(degraded), rng)
    here = draw.arm.forward_kinematics(at)
    angle = rng.uniform(0, 2 * np.pi)
    way = 0.3 * np.array([np.cos(angle), np.sin(angle), 0.0])
    return Case(task, degraded, at, rows=as_task(draw.arm, "pointing"), path=line(here, _moved(here, way)))


@_again
def _upright(draw: Draw, task: str, rng: Rng) -> Case:
    """From one configuration with the tool straight down to the pose of another; it leans by 2 deg at most on the way."""
    degraded = draw_failure(draw.arm, 2, rng)
    at, there = (draw.pointing_down(*_limits(degraded), rng) for _ in range(2))
    goal = draw.arm.forward_kinematics(there)
    keep = upright(_LEANS).anchored(draw.arm.forward_kinematics(at))
    return Case(task, degraded, at, rows=as_task(draw.arm, "pose"), goal=goal, keep=(keep,))


def _moved(pose: Array, way: Array) -> Array:
    moved = pose.copy()
    moved[:3, 3] += way
    return moved


TASKS: dict[str, Callable[[Draw, str, Rng], Case]] = {
    "reach-pose": _reach,
    "reach-pointing": _reach,
    "reach-position": _reach,
    "reach-healthy-pose": _reach,
    "reach-healthy-pointing": _reach,
    "reach-healthy-position": _reach,
    "line": _line,
    "drawer": _line,
    "wipe": _wipe,
    "tray": _tray,
    "upright": _upright,
}
