"""Choice of the tasks of an experiment from the bank, so that they cover the range of every measure.

Source: Goel et al. 2003, section 5 and Fig. 2; the deterministic rule is ours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.result import Result
from holdfast.core.typing import FloatArray, IndexArray
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task, as_task
from holdfast.teleop.bank.tasks import TaskBank
from holdfast.teleop.trials.driving import EndRules, Operator, drive_trials
from holdfast.teleop.trials.plant import JoystickPlant
from holdfast.teleop.trials.recordings import End
from holdfast.teleop.trials.scenarios import PointTasks
from holdfast.teleop.trials.stick import Joystick

_LEVEL_COUNT = 5  # a selection should contain equally many tasks of each fifth of each measure


@dataclass(frozen=True, eq=False)
class Binning:
    """Plane of difficulty and ratio, divided into equal cells.

    Attributes:
        difficulty: (columns + 1,) edges of CPM3.
        ratio: (rows + 1,) edges of CPM4 / CPM3.
        cell: (N,) index of the cell of each task, ``row * columns + column``; -1 where a scenario was not completed.
    """

    difficulty: FloatArray
    ratio: FloatArray
    cell: IndexArray

    @property
    def occupied_cells(self) -> IndexArray:
        """Indices of the cells that contain a task."""
        return np.unique(self.cell[self.cell >= 0])


def bin_tasks(bank: TaskBank, columns: int = 6, rows: int = 8) -> Binning:
    """Divide the range of a ``bank`` in the plane of CPM3 and CPM4/CPM3 into ``columns`` x ``rows`` equal cells.

    Raises:
        InputError: There is no cell, or no task was completed in every scenario.

    Source: Goel et al. 2003, Fig. 2: 48 cells by 6 x 8; which axis has 6 is not stated.
    """
    if columns < 1 or rows < 1:
        raise InputError(f"the plane cannot be divided into {columns} x {rows} cells; give 1 or more each way")
    completed = bank.is_completed()
    if not completed.any():
        raise InputError("no task of the bank was completed in every scenario; give more tasks")
    cell = np.full(len(bank), -1, dtype=np.int64)
    edges = [
        np.linspace(values[completed].min(), values[completed].max(), count + 1)
        for values, count in ((bank.difficulty, columns), (bank.ratio, rows))
    ]
    column, row = (
        np.clip(np.searchsorted(bounds, values[completed], side="right") - 1, 0, len(bounds) - 2)
        for bounds, values in zip(edges, (bank.difficulty, bank.ratio), strict=True)
    )
    cell[completed] = row * columns + column
    return Binning(edges[0], edges[1], cell)


def select_tasks(bank: TaskBank, cells: Binning, count: int = 22) -> IndexArray:
    """Select tasks of the bank, one from each occupied cell, that together cover the range of every measure.

    Each measure of scenario 3 is replaced by its rank. The selection makes the numbers of tasks in the fifths of each measure
    as equal as exchanges of single tasks can, beginning with the task nearest to the middle of each cell. With fewer cells than
    requested tasks, the fullest cells contribute a second one; with more, the emptiest cells contribute none.

    Args:
        bank: Task bank.
        cells: Cells of the bank, from :func:`bin_tasks`.
        count: Number of tasks.

    Returns:
        (count,) indices into the bank, by difficulty.

    Raises:
        InputError: More tasks are requested than were completed in every scenario, or fewer than 1.
    """
    eligible = np.flatnonzero(cells.cell >= 0)
    if not 1 <= count <= eligible.size:
        raise InputError(f"{count} tasks are requested; the bank has {eligible.size} that were completed in every scenario")
    cell_numbers, sizes = np.unique(cells.cell[eligible], return_counts=True)
    by_size = cell_numbers[np.lexsort((cell_numbers, -sizes))]
    task_cells = _choose_task_cells(by_size, dict(zip(cell_numbers.tolist(), sizes.tolist(), strict=True)), count)
    levels = _compute_measure_levels(bank, eligible)
    chosen = _choose_tasks_near_centers(bank, cells, task_cells)
    members = {cell: np.flatnonzero(cells.cell == cell) for cell in cell_numbers.tolist()}
    target_count = count / _LEVEL_COUNT
    changed = True
    while changed:
        changed = False
        for slot, cell in enumerate(task_cells):
            other_slots = np.delete(np.arange(count), slot)
            histogram = sum(_one_hot(levels[chosen[other]]) for other in other_slots)
            candidates = np.setdiff1d(members[cell], chosen[other_slots])
            costs = ((histogram + _one_hot(levels[candidates]) - target_count) ** 2).sum(axis=(1, 2))
            best = candidates[int(np.argmin(costs))]
            current_cost = costs[np.flatnonzero(candidates == chosen[slot])[0]]
            if costs.min() < current_cost - 1e-9:
                chosen[slot], changed = best, True
    return chosen[np.argsort(bank.difficulty[chosen], kind="stable")]


def _choose_task_cells(by_size: IndexArray, sizes: dict[int, int], count: int) -> list[int]:
    """Return the cell of each task to be chosen: each occupied cell once, then the fullest cells again up to ``count``."""
    task_cells: list[int] = []
    remaining = dict(sizes)
    while len(task_cells) < count:
        task_cells += [int(cell) for cell in by_size if remaining[int(cell)] > 0][: count - len(task_cells)]
        remaining = {cell: size - 1 for cell, size in remaining.items()}
    return task_cells


def _compute_measure_levels(bank: TaskBank, eligible: IndexArray) -> NDArray[np.int64]:
    """Return the level (N, 11), from 0, of each task in each measure of scenario 3."""
    values = bank.measures[bank.scenario_index("pseudoinverse", failed=True)]
    levels = np.zeros(values.shape, dtype=np.int64)
    ranks = np.argsort(np.argsort(values[eligible], axis=0, kind="stable"), axis=0, kind="stable")
    levels[eligible] = ranks * _LEVEL_COUNT // eligible.size
    return levels


def _one_hot(levels: NDArray[np.int64]) -> FloatArray:
    return np.asarray(levels[..., None] == np.arange(_LEVEL_COUNT), dtype=np.float64)


def _choose_tasks_near_centers(bank: TaskBank, cells: Binning, task_cells: list[int]) -> IndexArray:
    columns = len(cells.difficulty) - 1
    centers = [0.5 * (edges[1:] + edges[:-1]) for edges in (cells.difficulty, cells.ratio)]
    widths = [max(edges[1] - edges[0], 1e-300) for edges in (cells.difficulty, cells.ratio)]
    chosen: list[int] = []
    for cell in task_cells:
        candidates = np.setdiff1d(np.flatnonzero(cells.cell == cell), chosen)
        difficulty_offset = (bank.difficulty[candidates] - centers[0][cell % columns]) / widths[0]
        ratio_offset = (bank.ratio[candidates] - centers[1][cell // columns]) / widths[1]
        distances = np.hypot(difficulty_offset, ratio_offset)
        chosen.append(int(candidates[np.argmin(distances)]))
    return np.array(chosen)


def find_most_disorienting(bank: TaskBank, excluded: IndexArray) -> int:
    """Return the index of the most disorienting task of a ``bank``, without the indices ``excluded`` (K,).

    It has the largest direction errors and retreat (M10 x M5 of scenario 3).

    Raises:
        InputError: No other task was completed in every scenario.
    """
    values = bank.measures[bank.scenario_index("pseudoinverse", failed=True)]
    scores = np.where(bank.is_completed(), values[:, 9] * values[:, 4], -np.inf)
    scores[excluded] = -np.inf
    if not np.isfinite(scores).any():
        raise InputError("no task remains for the most disorienting one; give more tasks")
    return int(np.argmax(scores))


def find_trapped_task(bank: TaskBank, arm: Arm, task: str | Task | Sequence[str] = "planar", *, seed: int = 0) -> int | None:
    """Return a task in which the failed arm under the pseudoinverse stops at a stationary point, although the task is feasible.

    The computer, which steers straight, must stop short of the target in scenario 3, and steering via one of 64 random
    waypoints must bring the end effector into the target circle.

    Args:
        bank: Task bank.
        arm: Arm of the tasks.
        task: Task rows that the joystick moves.
        seed: Seed of the random waypoints.

    Returns:
        Index into the bank; None if it contains no such task.
    """
    scenario = bank.scenario_index("pseudoinverse", failed=True)
    stuck_tasks = np.flatnonzero(bank.end[scenario] == End.STILL)
    plant = JoystickPlant(bank.scenarios[scenario].make_law(arm, task))
    for candidate in stuck_tasks:
        if can_be_steered(plant, bank.tasks.take(np.array([candidate])), seed):
            return int(candidate)
    return None


def can_be_steered(plant: JoystickPlant, task: PointTasks, seed: int = 0, *, tries: int = 64) -> bool:
    """Return whether one failed task can be completed via some random waypoint.

    Args:
        plant: Arm and control law.
        task: One task.
        seed: Seed of the random waypoints.
        tries: Number of waypoints.
    """
    generator = np.random.default_rng(seed)
    start = plant.position(task.q0)[0]
    distance = np.linalg.norm(task.target[0] - start)
    waypoints = 0.5 * (start + task.target[0]) + generator.uniform(-distance, distance, (tries, plant.m))
    trials = drive_trials(
        [plant],
        np.zeros(tries, dtype=np.int64),
        np.repeat(task.q0, tries, axis=0),
        target=np.repeat(task.target, tries, axis=0),
        healthy=np.repeat(task.healthy_mask(True), tries, axis=0),
        operator=WaypointOperator(waypoints),
        stick=Joystick(),
        rules=EndRules(cycle_limit=2000, patience=2000),
    )
    return bool(trials.is_completed.any())


@dataclass(frozen=True, eq=False, kw_only=True)
class TaskChoice(Result):
    """Tasks of a bank chosen for an experiment, returned by :func:`choose_tasks`.

    Attributes:
        bank, arm, task: Task bank, its arm, and the rows that the joystick moves.
        cells: Plane of difficulty and ratio.
        chosen: (k,) indices into the bank, by difficulty.
        disorienting: Index of the most disorienting of the other tasks; None if it was not requested.
        trapped: Index of a task in which the failed arm converges to a stationary point; None if there is none, or it was not
            requested.
        seed: Seed of the tasks and of the search for waypoints.
    """

    bank: TaskBank
    arm: Arm
    task: Task
    cells: Binning
    chosen: IndexArray
    disorienting: int | None
    trapped: int | None
    seed: int

    @property
    def special_tasks(self) -> IndexArray:
        """Indices of the special tasks."""
        return np.array([task for task in (self.disorienting, self.trapped) if task is not None], dtype=np.int64)


def choose_tasks(
    bank: TaskBank,
    arm: Arm,
    task: str | Task | Sequence[str] = "planar",
    *,
    count: int = 22,
    special: bool = True,
    seed: int = 0,
) -> TaskChoice:
    """Choose tasks of a bank for an experiment: those of :func:`select_tasks`, and two special ones.

    Args:
        bank: Tasks with the trials of the computer.
        arm: Arm of the tasks.
        task: Task rows that the joystick moves.
        count: Number of tasks, without the special ones.
        special: Add the tasks of :func:`find_most_disorienting` and :func:`find_trapped_task`.
        seed: Seed of the bank, also used for the random waypoints.

    Raises:
        InputError: Too few tasks were completed in every scenario.
    """
    cells = bin_tasks(bank)
    chosen = select_tasks(bank, cells, count)
    return TaskChoice(
        bank=bank,
        arm=arm,
        task=as_task(arm, task),
        cells=cells,
        chosen=chosen,
        disorienting=find_most_disorienting(bank, chosen) if special else None,
        trapped=find_trapped_task(bank, arm, task, seed=seed) if special else None,
        seed=seed,
    )


class WaypointOperator(Operator):
    """Operator that steers towards a waypoint, until it arrives or 60 cycles have passed, and then straight to the target.

    Args:
        via: (N, m) waypoints, m.
    """

    def __init__(self, via: FloatArray) -> None:
        self._waypoints = via

    def begin(self, x: FloatArray, target: FloatArray) -> None:
        """See :meth:`Operator.begin`."""
        self._cycles_left = np.full(len(x), 60)  # cycles: 3 m at full speed

    def command_velocity(self, rows: IndexArray, cycle: int, x: FloatArray, *, target: FloatArray) -> FloatArray:
        """See :meth:`Operator.command_velocity`."""
        self._cycles_left[rows] -= 1
        arrived = np.linalg.norm(self._waypoints[rows] - x, axis=1) < 0.05
        self._cycles_left[rows[arrived]] = 0
        goal = np.where((self._cycles_left[rows] > 0)[:, None], self._waypoints[rows], target)
        return np.asarray(goal - x)
