"""Arms judged as wholes: measures over a region, over joint space and over the workspace in one table, with intervals."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arguments import checked
from holdfast.arm.configurations import finite_limits
from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task, plane_normal
from holdfast.designs.designs import Checked
from holdfast.designs.search import drawn_poses
from holdfast.errors import InputError, TaskError
from holdfast.failures import FailureSpec
from holdfast.indices.determinants import RelativeManipulability
from holdfast.notice import Count, says
from holdfast.probability.intervals import Interval
from holdfast.reach.tolerance import tolerant_workspace
from holdfast.regions.region import Region, default_region
from holdfast.result import Result
from holdfast.solvers.optima import optimise
from holdfast.solvers.self_motions import fibres

Array = NDArray[np.float64]
_Cell = tuple[str, str, int, Interval]  # name and unit of a column, of how many samples, and what one arm has

MEASURES = ("quantile", "fraction-above", "self-motion-size", "tolerant-workspace")
CONFIDENCE = 0.95  # of all intervals
_SPACING, _STARTS = 0.05, 32  # rad; of self-motions


@dataclass(frozen=True, kw_only=True)
class Measured:
    """A column of a judgement: what all arms are measured by.

    Attributes:
        measure: One of the measures.
        name: For people.
        unit: Of the values; ``1`` if they have none.
        samples: That each value is of, poses, configurations or points; 0 where it is exact.
    """

    measure: str
    name: str
    unit: str
    samples: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Judgement(Result):
    """What :func:`judge` measured.

    Attributes:
        arms: The arms, a row each.
        task: The rows of a pose that matter.
        failures: How many joints lock at once, at most.
        region: Whose poses were drawn.
        columns: What was measured.
        values: (A, C) of each arm; for all of them larger is better.
        low, high: (A, C) ends of the 95 % intervals.
        left_out: Measures that were not asked for by name and are not defined for all the arms, and why.
        level: Fraction of the poses that have at least a quantile.
        seed: Of all draws.
        seconds: What it took.
    """

    arms: tuple[Arm, ...]
    task: Task
    failures: int
    region: Region
    columns: tuple[Measured, ...]
    values: Array
    low: Array
    high: Array
    left_out: tuple[str, ...]
    level: float
    seed: int
    seconds: float

    def front(self, *names: str) -> NDArray[np.int64]:
        """Arms, from 0, than which no other is better in all of some columns; what intervals do not tell apart is equal.

        Args:
            names: Of columns; all if none is given.

        Raises:
            InputError: There is no such column.
        """
        known = [c.name for c in self.columns]
        for name in names:
            if name not in known:
                raise InputError(f"there is no column '{name}'; there are {', '.join(known)}")
        chosen = [known.index(name) for name in names or known]
        low, high = self.low[:, chosen], self.high[:, chosen]
        # No column is worse, as far as can be told, and one is better for sure.
        no_worse = (high[:, None] >= low[None]).all(axis=2)
        better = (low[:, None] > high[None]).any(axis=2)
        return np.flatnonzero(~(no_worse & better).any(axis=0))

    def describe(self) -> list[str]:
        """The best arm of each column, and what is left out."""
        named = ", ".join(arm.name for arm in self.arms)
        lines = [f"{named}: task {self.task.name}, {self.region.name}, seed {self.seed}; intervals of {_percents(CONFIDENCE)}"]
        for c, column in enumerate(self.columns):
            best = int(self.values[:, c].argmax())
            unit = "" if column.unit == "1" else f" {column.unit}"
            which = f", {self.arms[best].name}" if len(self.arms) > 1 else ""
            spread = f"{self.low[best, c]:.4g} to {self.high[best, c]:.4g}"
            lines.append(f"{column.name}: {self.values[best, c]:.4g}{unit} ({spread}){which}")
        return [*lines, *self.left_out]


@checked
@says("judging arms")
def judge(
    arms: Arm | Sequence[Arm],
    region: Region | None = None,
    *,
    task: str | Task | Sequence[str] = "pose",
    failures: FailureSpec = "single",
    measures: Sequence[str] | None = None,
    level: float = 0.95,
    thresholds: Sequence[float] = (0.05, 0.1, 0.2, 0.3),
    poses: int = 100,
    samples: int = 20_000,
    points: int = 300,
    best_limits: bool = False,
    seed: int = 0,
) -> Judgement:
    """Judge arms as wholes: a configuration at a ceiling says nothing about the rest of an arm.

    - ``quantile``: relative manipulability, at the best configuration of each pose of the region, that the fraction ``level``
      of the poses has at least; poses out of reach have 0.
    - ``fraction-above``: of the joint space, within the limits or full circles, that keeps each threshold.
    - ``self-motion-size``: whole turns of all joints on one curve of a pose: the median over the region, and what the fraction
      ``level`` of the poses has at least; for one degree of redundancy.
    - ``tolerant-workspace``: points that are reached before and after any one lock, of the disc or ball of the arm's length.

    Args:
        arms: An arm, or several that are judged on the same poses.
        region: Of poses. Default: around the home of the first arm.
        task: Rows of the pose that matter; a tolerant workspace is that of positions, or of places in the plane of the arm.
        failures: Joints that lock at once; a tolerant workspace is of single locks.
        measures: Some of them. Default: all that are defined for the arms.
        level: Fraction of the poses.
        thresholds: Of relative manipulability.
        poses: Drawn from the region.
        samples: Configurations of each arm.
        points: Of the workspace, where it is sampled.
        best_limits: Look for the artificial limits with which the tolerant workspace is largest: takes long where it is
            sampled. Default: the arm's own limits, which a joint may lock at.
        seed: Of all draws.

    Raises:
        InputError: No arm, an unknown measure, thresholds or counts out of range.
        TaskError: No redundancy; the size of self-motions is asked for and there is more than one degree of it.

    Source: derived here.
    """
    begin = time.monotonic()
    some = (arms,) if isinstance(arms, Arm) else tuple(arms)
    if not some:
        raise InputError("there is no arm to judge")
    wrong = [m for m in measures or () if m not in MEASURES]
    if wrong:
        raise InputError(f"'{wrong[0]}' is no measure; there are {', '.join(MEASURES)}")
    if min(poses, samples, points) < 1 or not 0 < level < 1 or not thresholds:
        raise InputError("give at least 1 pose, sample, point and threshold, and a level between 0 and 1")
    tasks = [as_task(arm, task) for arm in some]
    chosen, left_out = list(measures or MEASURES), list[str]()
    spare = {arm.n - rows.m for arm, rows in zip(some, tasks, strict=True)}
    if spare != {1} and "self-motion-size" in chosen:
        said = f"the size of self-motions needs one degree of redundancy; here it is {', '.join(map(str, sorted(spare)))}"
        if measures is not None:
            raise TaskError(said)
        chosen.remove("self-motion-size")
        left_out.append(said)
    where = default_region(some[0]) if region is None else region
    targets, weights = drawn_poses(where, poses, seed)
    drawn = _Drawn(
        where,
        targets,
        np.empty(0) if weights is None else weights,
        level,
        tuple(thresholds),
        samples,
        points,
        best_limits,
        seed,
    )
    ways = {
        "quantile": drawn.quantile,
        "fraction-above": drawn.above,
        "self-motion-size": drawn.sizes,
        "tolerant-workspace": drawn.workspace,
    }
    columns: list[Measured] = []
    cells: list[list[Interval]] = []
    most = 0
    with Count("arms", len(some), whole=True) as step:
        for arm, rows in zip(some, tasks, strict=True):
            index = RelativeManipulability(arm, rows, failures)
            most = max(most, *map(len, index.failures))
            found = [(measure, *cell) for measure in chosen for cell in ways[measure](index)]
            columns = [Measured(measure=measure, name=name, unit=unit, samples=size) for measure, name, unit, size, _ in found]
            cells.append([interval for *_, interval in found])
            step(1)
    return Judgement(
        arms=some,
        task=tasks[0],
        failures=most,
        region=where,
        columns=tuple(columns),
        values=np.array([[x.value for x in row] for row in cells]),
        low=np.array([[x.low for x in row] for row in cells]),
        high=np.array([[x.high for x in row] for row in cells]),
        left_out=tuple(left_out),
        level=level,
        seed=seed,
        seconds=time.monotonic() - begin,
    )


@dataclass(frozen=True)
class _Drawn:
    """The poses, and how much else is drawn: the same for all arms."""

    region: Region
    poses: Array
    weights: Array
    level: float
    thresholds: tuple[float, ...]
    samples: int
    points: int
    best_limits: bool
    seed: int

    def _of_poses(self, values: Array, level: float) -> Interval:
        there = np.ones(len(values), dtype=bool)
        return Checked.of(values, there, self.weights, level=level, heaviest=self.region.heaviest).guaranteed

    def quantile(self, index: RelativeManipulability) -> list[_Cell]:
        best = optimise(index.arm, self.poses, index, seed=self.seed)
        kept = self._of_poses(np.where(best.success, best.value, 0.0), self.level)
        return [(f"kept at {_percents(self.level)} of the poses", "1", len(self.poses), kept)]

    def above(self, index: RelativeManipulability) -> list[_Cell]:
        low, high = finite_limits(index.arm)
        value = index(np.random.default_rng(self.seed).uniform(low, high, (self.samples, index.arm.n)))
        hits = [int((value >= h).sum()) for h in self.thresholds]
        return [
            (f"joint space at {h:g} or more", "1", self.samples, Interval.of(count, self.samples, CONFIDENCE))
            for h, count in zip(self.thresholds, hits, strict=True)
        ]

    def sizes(self, index: RelativeManipulability) -> list[_Cell]:
        found = fibres(index.arm, self.poses, index.task, spacing=_SPACING, starts=_STARTS, seed=self.seed)
        turns = np.array([each.size for each in found]) / (2 * np.pi)
        levels = {"self-motion, median": 0.5, f"self-motion at {_percents(self.level)} of the poses": self.level}
        return [(name, "turns", len(turns), self._of_poses(turns, level)) for name, level in levels.items()]

    def workspace(self, index: RelativeManipulability) -> list[_Cell]:
        flat = plane_normal(index.arm) is not None
        rows, options = "planar" if flat else "position", {"points": self.points, "seed": self.seed}
        found = tolerant_workspace(index.arm, rows, optimise=self.best_limits, confidence=CONFIDENCE, **options)
        length = index.arm.end_to_end
        whole = np.pi * length**2 if flat else 4 / 3 * np.pi * length**3
        value, low, high = (x / whole for x in (found.size, *found.size_interval))
        interval = Interval(value=value, low=low, high=high, confidence=CONFIDENCE)
        unit, points = f"of the {'disc' if flat else 'ball'}", 0 if found.exact else self.points
        return [("workspace that every lock leaves", unit, points, interval)]


def _percents(fraction: float) -> str:
    return f"{100 * fraction:g} %"
