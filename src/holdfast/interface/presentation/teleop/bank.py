"""Figure of the task bank: the difficulty of each task, and the law that performs better."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import IndexArray
from holdfast.interface import report
from holdfast.interface.report.palette import BLUE, FAINT, INK, ORANGE, SOFT
from holdfast.teleop.bank.selection import Binning
from holdfast.teleop.bank.tasks import TaskBank


def bank_figure(
    bank: TaskBank, cells: Binning, chosen: IndexArray | None = None, *, special: IndexArray | None = None
) -> report.Figure:
    """Draw CPM4/CPM3 of the tasks of a bank against CPM3, with the grid of cells and the numbers of the chosen tasks.

    Args:
        bank: Tasks with the performance measures under computer control.
        cells: Grid of cells of CPM3 and CPM4/CPM3.
        chosen: (k,) indices of chosen tasks in the bank, which are numbered from 1 in this order.
        special: Indices of special tasks in the bank, which have the next numbers and other markers. Special tasks that were
            not completed in every scenario have no position in the figure; its title names them.

    Source: Goel et al. 2003, Fig. 2.
    """
    chosen_tasks = np.array([], dtype=np.int64) if chosen is None else np.asarray(chosen, dtype=np.int64)
    special_tasks = np.array([], dtype=np.int64) if special is None else np.asarray(special, dtype=np.int64)
    with report.styled_figure(report.WIDTH_IN, 6.2) as figure:
        axes = figure.add_subplot()
        _draw_bank(axes, bank, cells)
        _label_tasks(axes, bank, chosen_tasks, 1, special=False)
        is_drawable = bank.is_completed()[special_tasks]
        _label_tasks(axes, bank, special_tasks[is_drawable], len(chosen_tasks) + 1 + np.flatnonzero(is_drawable), special=True)
        missing_numbers = [str(len(chosen_tasks) + 1 + index) for index in np.flatnonzero(~is_drawable)]
        incomplete_count = int((~bank.is_completed()).sum())
        cell_count = (len(cells.difficulty) - 1) * (len(cells.ratio) - 1)
        title = f"{len(bank)} tasks under computer control in {len(cells.occupied_cells)} of {cell_count} cells"
        if incomplete_count:
            title += f"; {incomplete_count} not completed in every scenario are not shown"
        if missing_numbers:
            title += f", task {' and '.join(missing_numbers)} among them"
        axes.set_title(title, fontweight="normal", fontsize=9.5)
        report.legend_below(figure, axes, 4)
    return figure


def _draw_bank(axes: report.Axes, bank: TaskBank, cells: Binning) -> None:
    easiest, hardest = cells.difficulty[[0, -1]]
    lower, upper = cells.ratio[[0, -1]]
    tolerant_scenario = bank.scenarios[bank.scenario_index("failure-tolerant", failed=True)].number
    pseudoinverse_scenario = bank.scenarios[bank.scenario_index("pseudoinverse", failed=True)].number
    if lower < 1:
        axes.axhspan(lower, min(1.0, upper), color="#e3eef7", zorder=0)
        axes.annotate(
            "failure-tolerant inverse is better",
            (hardest, min(1.0, upper)),
            (-6, -6),
            textcoords="offset points",
            ha="right",
            va="top",
            color=BLUE,
        )
    axes.axhline(1.0, color=INK, linewidth=1.0, zorder=1.5)
    axes.vlines(cells.difficulty, lower, upper, color=FAINT, linewidth=0.8, zorder=1)
    axes.hlines(cells.ratio, easiest, hardest, color=FAINT, linewidth=0.8, zorder=1)
    axes.scatter(bank.difficulty, bank.ratio, s=7, color=SOFT, alpha=0.55, linewidths=0, zorder=2, label="task of the bank")
    x_margin, y_margin = 0.02 * (hardest - easiest or 1.0), 0.02 * (upper - lower or 1.0)
    axes.set(
        xlabel=f"CPM{pseudoinverse_scenario}: failed arm, pseudoinverse (difficulty)",
        ylabel=f"CPM{tolerant_scenario} / CPM{pseudoinverse_scenario}",
        xlim=(easiest - x_margin, hardest + x_margin),
        ylim=(lower - y_margin, upper + y_margin),
    )
    axes.grid(visible=False)


def _label_tasks(axes: report.Axes, bank: TaskBank, rows: IndexArray, numbers: int | IndexArray, special: bool) -> None:
    from matplotlib.patheffects import withStroke

    if not len(rows):
        return
    difficulties, ratios = bank.difficulty[rows], bank.ratio[rows]
    marker_style = {"marker": "D", "color": ORANGE, "s": 42} if special else {"marker": "o", "color": BLUE, "s": 34}
    label = "special task" if special else "chosen task"
    axes.scatter(difficulties, ratios, edgecolors="white", linewidths=0.8, zorder=4, label=label, **marker_style)
    x_range, y_range = (np.diff(limits)[0] for limits in (axes.get_xlim(), axes.get_ylim()))
    for index, task_number in enumerate(np.arange(len(rows)) + numbers):
        is_near = (np.abs(difficulties[:index] - difficulties[index]) < 0.03 * x_range) & (
            np.abs(ratios[:index] - ratios[index]) < 0.06 * y_range
        )
        axes.annotate(
            str(task_number),
            (difficulties[index], ratios[index]),
            (5, -13) if is_near.any() else (5, 4),
            textcoords="offset points",
            fontsize=9,
            color=INK,
            fontweight="bold",
            path_effects=[withStroke(linewidth=2.2, foreground="white")],
            zorder=5,
        )
