"""The tasks of an experiment, chosen from the bank so that they cover the range of every measure.

Source: Goel et al. 2003, section 5 and Fig. 2; the deterministic rule is ours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arm.task import Task, as_task
from holdfast.errors import InputError
from holdfast.result import Result
from holdfast.teleop.bank.tasks import TaskBank
from holdfast.teleop.trials.driving import Operator, Rules, drive
from holdfast.teleop.trials.plant import Plant
from holdfast.teleop.trials.recordings import End
from holdfast.teleop.trials.scenarios import PointTasks
from holdfast.teleop.trials.stick import Stick

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

_LEVELS = 5  # a selection should hold equally many tasks of each fifth of each measure


@dataclass(frozen=True, eq=False)
class Binning:
    """The plane of difficulty and ratio, cut into equal cells.

    Attributes:
        difficulty: (columns + 1,) edges of CPM3.
        ratio: (rows + 1,) edges of CPM4 / CPM3.
        cell: (N,) number of the cell of each task, ``row * columns + column``; -1 where a scenario was not completed.
    """

    difficulty: Array
    ratio: Array
    cell: Indices

    @property
    def occupied(self) -> Indices:
        """Numbers of the cells that hold a task."""
        return np.unique(self.cell[self.cell >= 0])


def binning(bank: TaskBank, columns: int = 6, rows: int = 8) -> Binning:
    """Cut the plane of CPM3 and CPM4/CPM3 into ``columns x rows`` equal cells over the whole range of the bank.

    Raises:
        InputError: Fewer than one cell, or no task that was completed in every scenario.

    Source: Goel et al. 2003, Fig. 2: 48 cells by 6 x 8; which axis has 6 is not stated.
    """
    if columns < 1 or rows < 1:
        raise InputError(f"the plane cannot be cut into {columns} x {rows} cells; give 1 or more each way")
    good = bank.completed()
    if not good.any():
        raise InputError("no task of the bank was completed in every scenario; give more tasks")
    cell = np.full(len(bank), -1, dtype=np.int64)
    edges = [np.linspace(v[good].min(), v[good].max(), k + 1) for v, k in ((bank.difficulty, columns), (bank.ratio, rows))]
    column, row = (
        np.clip(np.searchsorted(e, v[good], side="right") - 1, 0, len(e) - 2)
        for e, v in zip(edges, (bank.difficulty, bank.ratio), strict=True)
    )
    cell[good] = row * columns + column
    return Binning(edges[0], edges[1], cell)


def select(bank: TaskBank, cells: Binning, count: int = 22) -> Indices:
    """Tasks of the bank, one from each cell that holds any, that together cover the range of every measure.

    Each measure of scenario 3 is replaced by its rank; the choice makes the numbers of tasks in the fifths of each measure
    as equal as an exchange of one task at a time can, beginning with the task nearest the middle of each cell. With fewer
    cells than tasks wanted, the fullest cells give a second one; with more, the emptiest cells give none.

    Returns:
        (count,) indices into the bank, by difficulty.

    Raises:
        InputError: More tasks wanted than were completed in every scenario, or fewer than 1.
    """
    good = np.flatnonzero(cells.cell >= 0)
    if not 1 <= count <= good.size:
        raise InputError(f"{count} tasks were asked for; the bank holds {good.size} that were completed in every scenario")
    numbers, sizes = np.unique(cells.cell[good], return_counts=True)
    by_size = numbers[np.lexsort((numbers, -sizes))]
    places = _places(by_size, dict(zip(numbers.tolist(), sizes.tolist(), strict=True)), count)
    level = _levels(bank, good)
    chosen = _nearest_the_middle(bank, cells, places)
    members = {c: np.flatnonzero(cells.cell == c) for c in numbers.tolist()}
    wanted = count / _LEVELS
    changed = True
    while changed:
        changed = False
        for place, c in enumerate(places):
            others = np.delete(np.arange(count), place)
            histogram = sum(_one_hot(level[chosen[k]]) for k in others)
            candidates = np.setdiff1d(members[c], chosen[others])
            cost = ((histogram + _one_hot(level[candidates]) - wanted) ** 2).sum(axis=(1, 2))
            best = candidates[int(np.argmin(cost))]
            here = cost[np.flatnonzero(candidates == chosen[place])[0]]
            if cost.min() < here - 1e-9:
                chosen[place], changed = best, True
    return chosen[np.argsort(bank.difficulty[chosen], kind="stable")]


def _places(by_size: Indices, sizes: dict[int, int], count: int) -> list[int]:
    """The cell of each task to be chosen: one each, and more of the fullest while tasks are wanted."""
    places: list[int] = []
    left = dict(sizes)
    while len(places) < count:
        places += [int(c) for c in by_size if left[int(c)] > 0][: count - len(places)]
        left = {c: n - 1 for c, n in left.items()}
    return places


def _levels(bank: TaskBank, good: Indices) -> NDArray[np.int64]:
    """(N, 11) fifth, from 0, of each task in each measure of scenario 3."""
    values = bank.measures[bank.scenario("pseudoinverse", failed=True)]
    level = np.zeros(values.shape, dtype=np.int64)
    rank = np.argsort(np.argsort(values[good], axis=0, kind="stable"), axis=0, kind="stable")
    level[good] = rank * _LEVELS // good.size
    return level


def _one_hot(level: NDArray[np.int64]) -> Array:
    return np.asarray(level[..., None] == np.arange(_LEVELS), dtype=np.float64)


def _nearest_the_middle(bank: TaskBank, cells: Binning, places: list[int]) -> Indices:
    columns = len(cells.difficulty) - 1
    middles = [0.5 * (e[1:] + e[:-1]) for e in (cells.difficulty, cells.ratio)]
    width = [max(e[1] - e[0], 1e-300) for e in (cells.difficulty, cells.ratio)]
    chosen: list[int] = []
    for c in places:
        rows = np.setdiff1d(np.flatnonzero(cells.cell == c), chosen)
        across = (bank.difficulty[rows] - middles[0][c % columns]) / width[0]
        upward = (bank.ratio[rows] - middles[1][c // columns]) / width[1]
        away = np.hypot(across, upward)
        chosen.append(int(rows[np.argmin(away)]))
    return np.array(chosen)


def most_disorienting(bank: TaskBank, besides: Indices) -> int:
    """The task whose direction errors and retreat (M10 x M5 of scenario 3) are largest, among those not chosen yet.

    Raises:
        InputError: No other task was completed in every scenario.
    """
    values = bank.measures[bank.scenario("pseudoinverse", failed=True)]
    score = np.where(bank.completed(), values[:, 9] * values[:, 4], -np.inf)
    score[besides] = -np.inf
    if not np.isfinite(score).any():
        raise InputError("no task is left to be the most disorienting one; give more tasks")
    return int(np.argmax(score))


def trapped(bank: TaskBank, arm: Arm, task: str | Task | Sequence[str] = "planar", *, seed: int = 0) -> int | None:
    """A task in which the failed arm under the pseudoinverse is drawn to a stationary point, but which can be done.

    The computer, steering straight, must stop short of the target in scenario 3; and some other way of steering, by one of 64
    random points on the way, must bring the end effector into the circle.

    Returns:
        Index into the bank; None if it holds no such task.
    """
    k = bank.scenario("pseudoinverse", failed=True)
    rows = np.flatnonzero(bank.end[k] == End.STILL)
    plant = Plant(bank.scenarios[k].make_law(arm, task))
    for row in rows:
        if can_be_steered(plant, bank.tasks.take(np.array([row])), seed):
            return int(row)
    return None


def can_be_steered(plant: Plant, task: PointTasks, seed: int = 0, *, tries: int = 64) -> bool:
    """Whether one failed task can be completed by way of some random point.

    Args:
        plant: The arm and law.
        task: One task.
        seed: Of the random points.
        tries: How many.
    """
    generator = np.random.default_rng(seed)
    start = plant.position(task.q0)[0]
    size = np.linalg.norm(task.target[0] - start)
    via = 0.5 * (start + task.target[0]) + generator.uniform(-size, size, (tries, plant.m))
    trials = drive(
        [plant],
        np.zeros(tries, dtype=np.int64),
        np.repeat(task.q0, tries, axis=0),
        target=np.repeat(task.target, tries, axis=0),
        healthy=np.repeat(task.healthy(True), tries, axis=0),
        operator=Detour(via),
        stick=Stick(),
        rules=Rules(cycle_limit=2000, patience=2000),
    )
    return bool(trials.completed.any())


@dataclass(frozen=True, eq=False, kw_only=True)
class TaskChoice(Result):
    """Tasks of a bank for an experiment: :func:`choose_tasks` makes it.

    Attributes:
        bank, arm, task: The tasks, of which arm, and the rows that the stick moves.
        cells: The plane of difficulty and ratio.
        chosen: (k,) indices into the bank, by difficulty.
        disorienting: Index of the most disorienting of the others; None if it was not asked for.
        trapped: Index of a task in which the failed arm is drawn to a stationary point; None if there is none, or it was not
            asked for.
        seed: Of the tasks and of the search for ways round.
    """

    bank: TaskBank
    arm: Arm
    task: Task
    cells: Binning
    chosen: Indices
    disorienting: int | None
    trapped: int | None
    seed: int

    @property
    def apart(self) -> Indices:
        """The special tasks."""
        return np.array([k for k in (self.disorienting, self.trapped) if k is not None], dtype=np.int64)

    def describe(self) -> list[str]:
        """A few sentences for people; tasks are numbered from 1."""
        bank, good = self.bank, self.bank.completed()
        cells = (len(self.cells.difficulty) - 1) * (len(self.cells.ratio) - 1)
        lines = [
            f"Arm {self.arm.title}: {len(bank)} tasks in {len(bank.scenarios)} scenarios, the computer steers",
            "failure-tolerant inverse better with the failed arm (CPM4/CPM3 below 1): "
            f"{100 * float((bank.ratio[good] < 1).mean()):.0f} % of the tasks",
            f"{len(self.cells.occupied)} of {cells} cells of CPM3 and CPM4/CPM3 hold a task; chosen, by CPM3: "
            f"{' '.join(str(k + 1) for k in self.chosen)}",
        ]
        if self.disorienting is not None:
            lines += [
                f"most disorienting of the others: {self.disorienting + 1}",
                "no task of the bank draws the failed arm under the pseudoinverse to a stationary point and can yet be "
                "steered; another seed may have one, and the protocol goel2003 has one by construction"
                if self.trapped is None
                else f"drawn to a stationary point, and yet can be steered: {self.trapped + 1}",
            ]
        return lines


def choose_tasks(
    bank: TaskBank,
    arm: Arm,
    task: str | Task | Sequence[str] = "planar",
    *,
    count: int = 22,
    special: bool = True,
    seed: int = 0,
) -> TaskChoice:
    """Tasks of a bank for an experiment: those of :func:`select`, and two special ones.

    Args:
        bank: The tasks as the computer did them.
        arm: Whose they are.
        task: Rows that the stick moves.
        count: How many, without the special ones.
        special: Also :func:`most_disorienting` and :func:`trapped`.
        seed: As of the bank.

    Raises:
        InputError: Too few tasks were completed in every scenario.
    """
    cells = binning(bank)
    chosen = select(bank, cells, count)
    return TaskChoice(
        bank=bank,
        arm=arm,
        task=as_task(arm, task),
        cells=cells,
        chosen=chosen,
        disorienting=most_disorienting(bank, chosen) if special else None,
        trapped=trapped(bank, arm, task, seed=seed) if special else None,
        seed=seed,
    )


class Detour(Operator):
    """First towards a point on the way, for as long as it comes nearer; then straight at the target.

    Args:
        via: (N, m) the points, m.
    """

    def __init__(self, via: Array) -> None:
        self._via = via

    def begin(self, x: Array, target: Array) -> None:
        """See :meth:`Operator.begin`."""
        self._left = np.full(len(x), 60)  # cycles: 3 m at full speed

    def wanted(self, rows: Indices, cycle: int, x: Array, *, target: Array) -> Array:
        """See :meth:`Operator.wanted`."""
        self._left[rows] -= 1
        near = np.linalg.norm(self._via[rows] - x, axis=1) < 0.05
        self._left[rows[near]] = 0
        goal = np.where((self._left[rows] > 0)[:, None], self._via[rows], target)
        return np.asarray(goal - x)
