"""The task bank in one picture: how difficult each task is, and which law does better in it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast import arms
from holdfast.files.output import put
from holdfast.files.spreadsheet import csv_text
from holdfast.teleop.bank.selection import Binning, TaskChoice
from holdfast.teleop.bank.tasks import TaskBank
from holdfast.teleop.protocol.protocol import Protocol, read_protocol
from holdfast.teleop.records.tables import bank_table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


def figures(choice: TaskChoice) -> dict[str, Figure]:
    """The bank, with the tasks that were chosen."""
    return {"bank": bank_figure(choice.bank, choice.cells, choice.chosen, special=choice.apart)}


def save(choice: TaskChoice, folder: Path, spec: str) -> list[Path]:
    """bank.csv, protocol.yaml with these tasks, and bank.png.

    Args:
        choice: What was chosen.
        folder: Made if it is not there.
        spec: What the protocol names the arm by: a built-in name or a file.
    """
    from holdfast.report.figures import save_png

    written = put(folder, {"bank.csv": csv_text(bank_table(choice.bank, choice.arm, choice.cells))})
    protocol = _protocol(choice, spec).write(folder / "protocol.yaml")
    return [*written, protocol, save_png(choice.figures()["bank"], folder / "bank.png", 150)]


def _protocol(choice: TaskChoice, spec: str) -> Protocol:
    """The paper's protocol with this arm and these tasks."""
    bank, every = choice.bank, np.append(choice.chosen, choice.apart)
    file = None if spec in arms.names() else Path(spec)
    base = replace(
        read_protocol(),
        name=f"{choice.arm.name}, {len(every)} tasks of a bank of {len(bank)}, seed {choice.seed}",
        arm=choice.arm,
        arm_spec=spec if file is None else file.name,
        arm_file=file,
        rows=choice.task,
    )
    with np.errstate(invalid="ignore"):
        notes = [
            f"bank task {k + 1}, CPM3 {bank.difficulty[k]:.3f}, CPM4/CPM3 {bank.ratio[k]:.3f}"
            if np.isfinite(bank.ratio[k])
            else f"bank task {k + 1}, not completed by the computer in every scenario"
            for k in every
        ]
    return base.with_tasks(bank.tasks.take(every), notes)


def bank_figure(bank: TaskBank, cells: Binning, chosen: Indices | None = None, *, special: Indices | None = None) -> Figure:
    """Scatter of CPM3 against CPM4/CPM3 with the grid of cells; chosen tasks carry their numbers.

    Args:
        bank: The tasks as the computer did them.
        cells: The grid.
        chosen: (k,) indices into the bank: numbered from 1, in this order.
        special: Indices into the bank of special tasks: numbered on from there, and marked otherwise. Those that were
            not completed in every scenario have no place in the plane and are named below it.

    Source: Goel et al. 2003, Fig. 2.
    """
    from matplotlib.figure import Figure

    from holdfast.report.figures import WIDTH, finished, legend_below, style

    numbered = np.array([], dtype=np.int64) if chosen is None else np.asarray(chosen, dtype=np.int64)
    apart = np.array([], dtype=np.int64) if special is None else np.asarray(special, dtype=np.int64)
    with style():
        figure = Figure(figsize=(WIDTH, 6.2))
        axes = figure.add_subplot()
        _plane(axes, bank, cells)
        _labelled(axes, bank, numbered, 1, special=False)
        drawn = bank.completed()[apart]
        _labelled(axes, bank, apart[drawn], len(numbered) + 1 + np.flatnonzero(drawn), special=True)
        absent = [str(len(numbered) + 1 + k) for k in np.flatnonzero(~drawn)]
        lost = int((~bank.completed()).sum())
        words = f"{len(bank)} tasks under computer control; {len(cells.occupied)} of {_count(cells)} cells hold one"
        if lost:
            words += f"; {lost} not completed in every scenario are not shown"
        if absent:
            words += f", task {' and '.join(absent)} among them"
        axes.set_title(words, fontweight="normal", fontsize=9.5)
        legend_below(figure, axes, 4)
        return finished(figure)


def _plane(axes: Axes, bank: TaskBank, cells: Binning) -> None:
    from holdfast.report.figures import BLUE, FAINT, INK, SOFT

    left, right = cells.difficulty[[0, -1]]
    low, high = cells.ratio[[0, -1]]
    tolerant = bank.scenarios[bank.scenario("failure-tolerant", failed=True)].number
    plain = bank.scenarios[bank.scenario("pseudoinverse", failed=True)].number
    if low < 1:
        axes.axhspan(low, min(1.0, high), color="#e3eef7", zorder=0)
        axes.annotate(
            "failure-tolerant inverse does better",
            (right, min(1.0, high)),
            (-6, -6),
            textcoords="offset points",
            ha="right",
            va="top",
            color=BLUE,
        )
    axes.axhline(1.0, color=INK, linewidth=1.0, zorder=1.5)
    axes.vlines(cells.difficulty, low, high, color=FAINT, linewidth=0.8, zorder=1)
    axes.hlines(cells.ratio, left, right, color=FAINT, linewidth=0.8, zorder=1)
    axes.scatter(bank.difficulty, bank.ratio, s=7, color=SOFT, alpha=0.55, linewidths=0, zorder=2, label="task of the bank")
    across, upward = 0.02 * (right - left or 1.0), 0.02 * (high - low or 1.0)
    axes.set(
        xlabel=f"CPM{plain}: failed arm, pseudoinverse (difficulty)",
        ylabel=f"CPM{tolerant} / CPM{plain}",
        xlim=(left - across, right + across),
        ylim=(low - upward, high + upward),
    )
    axes.grid(visible=False)


def _labelled(axes: Axes, bank: TaskBank, rows: Indices, numbers: int | Indices, special: bool) -> None:
    from matplotlib.patheffects import withStroke

    from holdfast.report.figures import BLUE, INK, ORANGE

    if not len(rows):
        return
    x, y = bank.difficulty[rows], bank.ratio[rows]
    look = {"marker": "D", "color": ORANGE, "s": 42} if special else {"marker": "o", "color": BLUE, "s": 34}
    label = "special task" if special else "chosen task"
    axes.scatter(x, y, edgecolors="white", linewidths=0.8, zorder=4, label=label, **look)
    wide, tall = (np.diff(limits)[0] for limits in (axes.get_xlim(), axes.get_ylim()))
    for k, number in enumerate(np.arange(len(rows)) + numbers):
        near = (np.abs(x[:k] - x[k]) < 0.03 * wide) & (np.abs(y[:k] - y[k]) < 0.06 * tall)
        axes.annotate(
            str(number),
            (x[k], y[k]),
            (5, -13) if near.any() else (5, 4),
            textcoords="offset points",
            fontsize=9,
            color=INK,
            fontweight="bold",
            path_effects=[withStroke(linewidth=2.2, foreground="white")],
            zorder=5,
        )


def _count(cells: Binning) -> int:
    return (len(cells.difficulty) - 1) * (len(cells.ratio) - 1)
