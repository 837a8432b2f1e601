"""Figures of an analysis: difficulty, gains, cell means, distributions and power."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, StrMethodFormatter
from numpy.typing import NDArray

from holdfast.report.figures import BLUE, INK, ORANGE, SOFT, WIDTH, finished, legend_below, plain, style
from holdfast.teleop.analysis.correlations import Correlation
from holdfast.teleop.analysis.result import Analysis
from holdfast.teleop.trials.performance import MEASURES

Array = NDArray[np.float64]

COLORS = (BLUE, ORANGE, "#007a5e", "#a8497f", "#c58a00", "#4aa3d6")
_MARKS = ("o", "^", "s", "D", "v", "P")
_GREY = "#c3c9cf"
_ROUNDING = 1e-9
_WIDE_RANGE = 30  # largest over smallest: beyond, the axis is logarithmic


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """Tasks in a plane, with a correlation to go with it."""

    x: Array
    y: Array
    xlabel: str
    ylabel: str
    correlation: Correlation
    groups: NDArray[np.int64]
    equal: bool = False


def scatter_figure(panels: Sequence[Scatter], names: Sequence[str]) -> Figure:
    """Fig. 3: one dot for each task, coloured by its group."""
    with style():
        figure = Figure(figsize=(WIDTH * len(panels) / 3 if len(panels) < 3 else WIDTH, 3.9))
        for axes, p in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
            for k, name in enumerate(names):
                mine = p.groups == k
                axes.plot(p.x[mine], p.y[mine], _MARKS[k % 6], color=COLORS[k % 6], markersize=5, alpha=0.85, label=plain(name))
            axes.set(xlabel=p.xlabel, ylabel=p.ylabel, title=f"r = {p.correlation.r:.3f}, {p.correlation.n} tasks")
            if p.equal:
                both = np.concatenate([p.x, p.y])
                top = float(both[np.isfinite(both)].max(initial=1.0))
                axes.plot([0, top], [0, top], color=SOFT, linewidth=0.8, linestyle=(0, (4, 2)), zorder=0)
        legend_below(figure, figure.axes[0], len(names))
        return finished(figure)


def tasks_figure(a: Analysis, titles: tuple[str, str]) -> Figure:
    """Fig. 4: CPM of each task under each law, the tasks sorted by that under the reference; operators and computer."""
    table = a.table("tasks")
    kinds = [("median_operator", titles[0])] + ([] if a.computer is None else [("computer", titles[1])])
    numbers = [c.scenario for c in a.conditions]
    with style():
        figure = Figure(figsize=(WIDTH, 3.5 * len(kinds)))
        for axes, (kind, title) in zip(figure.subplots(len(kinds), 1, squeeze=False)[:, 0], kinds, strict=True):
            values = np.column_stack([table[f"{kind}_cpm_{n}"].to_numpy(dtype=np.float64) for n in numbers])
            order = np.argsort(np.where(np.isnan(values[:, 0]), np.inf, values[:, 0]), kind="stable")
            values, task = values[order], table["task"].to_numpy()[order]
            place = np.arange(len(values))
            for k in range(1, len(numbers)):
                better = values[:, k] < values[:, 0]
                color = [COLORS[k % 6] if b else _GREY for b in better]
                axes.vlines(place, values[:, 0], values[:, k], colors=color, linewidth=1.6, zorder=1)
            for k, c in enumerate(a.conditions):
                label = plain(f"CPM{c.scenario}: {c.law}")
                axes.plot(place, values[:, k], _MARKS[k % 6], color=COLORS[k % 6], markersize=5.5, label=label)
            top = float(np.nanmax(values, initial=0.0))
            for x in np.flatnonzero(np.isnan(values[:, 0])):
                axes.annotate("not completed", (float(x), 0.03 * top), ha="center", rotation=90, fontsize=8, color=SOFT)
            axes.set_xticks(place, [str(t) for t in task])
            axes.set(
                xlabel="task, sorted by its CPM under the reference law", ylabel="CPM", title=title, ylim=(0, 1.08 * (top or 1))
            )
            axes.grid(axis="x", visible=False)
        legend_below(figure, figure.axes[0], len(numbers))
        return finished(figure)


def cells_figure(a: Analysis) -> Figure:
    """Cell means with their intervals, and every subject behind them."""
    from scipy import stats

    values, names = a.cells.values, a.cells.groups
    with style():
        figure = Figure(figsize=(0.72 * WIDTH, 3.9))
        axes = figure.add_subplot()
        place = np.arange(len(names))
        for k, law in enumerate(a.cells.laws):
            shift = 0.16 * (k - (len(a.cells.laws) - 1) / 2)
            y = values[:, k]
            spread = np.linspace(-0.035, 0.035, len(y))[:, None]
            axes.plot(np.ravel(place + shift + spread), y.ravel(), ".", color=COLORS[k % 6], alpha=0.3, markersize=4, zorder=1)
            count = np.isfinite(y).sum(axis=0)
            half = stats.t.ppf(0.5 + a.confidence / 2, count - 1) * np.nanstd(y, axis=0, ddof=1) / np.sqrt(count)
            axes.errorbar(
                place + shift,
                np.nanmean(y, axis=0),
                half,
                color=COLORS[k % 6],
                marker=_MARKS[k % 6],
                markersize=6.5,
                capsize=4,
                linewidth=1.4,
                label=plain(law),
            )
        axes.set_xticks(place, [f"{plain(n)}\n({s} tasks)" for n, s in zip(names, a.groups.sizes, strict=True)])
        axes.set(ylabel="mean CPM of a subject, failed arm", ylim=(0, None))
        axes.grid(axis="x", visible=False)
        legend_below(figure, axes, len(a.cells.laws))
        return finished(figure)


def measures_figure(values: Sequence[Sequence[Array]], computer: Sequence[Array] | None, scenarios: Sequence[int]) -> Figure:
    """Figs 5 to 7: of CPM and each measure, in each scenario, the range, a histogram, mean, median and the computer.

    Args:
        values: For CPM and each measure (13, or 12 without ratings), for each scenario, the operators' values.
        computer: For CPM and M1 to M11 the computer's value in each scenario; None without one.
        scenarios: Their numbers.
    """
    with style():
        columns = 5
        lines = -(-len(values) // columns)
        tall = 2.2 * lines + 0.9
        # Many panels: placed by hand, the automatic layout would take most of the time.
        figure = Figure(figsize=(WIDTH, tall))
        figure.set_layout_engine("none")
        place = {"left": 0.05, "right": 0.995, "top": 1 - 0.4 / tall, "bottom": 0.8 / tall, "wspace": 0.34, "hspace": 0.46}
        every = figure.subplots(lines, columns, squeeze=False, gridspec_kw=place).ravel()
        for k, axes in enumerate(every):
            if k >= len(values):
                axes.set_visible(False)
                continue
            factor = 1.0 if k == 0 else shown(k - 1)[1]
            its = None if computer is None or k >= len(computer) else factor * computer[k]
            _distributions(axes, [factor * v for v in values[k]], its, scenarios)
            # In two lines where need be: panels are narrow, and titles of neighbours must not touch.
            axes.set_title(fill("CPM" if k == 0 else shown(k - 1)[0], 22), fontsize=8, pad=4)
        for axes in every[max(0, len(values) - columns) : len(values)]:
            axes.set_xlabel("scenario")
        figure.legend(handles=_key(computer is not None), loc="lower center", ncols=5, columnspacing=2.0)
        return finished(figure)


def shown(measure: int) -> tuple[str, float]:
    """Of a measure, from 0: its name with the unit that people read, and what its values are multiplied by for that."""
    m = MEASURES[measure]
    if m.name == "M12":
        return "M12 rating", 1.0
    if "direction" in m.about:
        return f"{m.name} {m.about}, °", float(np.degrees(1.0))
    return f"{m.name} {m.about}{'' if m.unit == '1' else f', {m.unit}'}", 1.0


def _distributions(axes: Axes, values: Sequence[Array], computer: Array | None, scenarios: Sequence[int]) -> None:
    there = [np.where(np.abs(v) < _ROUNDING, 0.0, v)[np.isfinite(v)] for v in values]
    its = np.full(len(there), np.nan) if computer is None else np.where(np.abs(computer) < _ROUNDING, 0.0, computer)
    everything = np.concatenate([*there, its[np.isfinite(its)]])
    if not everything.size:
        axes.annotate("none reached the target", (0.5, 0.5), xycoords="axes fraction", ha="center", color=SOFT)
        return
    low, high = float(everything.min()), float(everything.max())
    log = low > 0 and high > _WIDE_RANGE * low
    if high - low <= 1e-9 * max(abs(high), 1.0):
        low, high = low - 0.5, high + 0.5
    edges = np.geomspace(low, high, 17) if log else np.linspace(low, high, 17)
    for place, v in enumerate(there, start=1):
        if v.size:
            count, _ = np.histogram(np.clip(v, low, high), edges)
            width = 0.42 * count / count.max()
            axes.fill_betweenx(
                np.repeat(edges, 2)[1:-1], place, place + np.repeat(width, 2), color=_GREY, linewidth=0, zorder=1
            )
            axes.vlines(place, v.min(), v.max(), color=SOFT, linewidth=1.3, zorder=2)
            axes.hlines(np.median(v), place - 0.17, place + 0.42, color=BLUE, linewidth=1.7, zorder=3)
            axes.plot([place], [v.mean()], "x", color=INK, markersize=5, markeredgewidth=1.2, zorder=4)
    axes.plot(
        np.arange(1, len(there) + 1), its, "o", color=ORANGE, markersize=5.2, fillstyle="none", markeredgewidth=1.4, zorder=5
    )
    axes.set_xticks(range(1, len(there) + 1), [str(s) for s in scenarios])
    axes.set_xlim(0.6, len(there) + 0.6)
    if log:
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 3), numticks=6))
        axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.minorticks_off()
    else:
        axes.yaxis.set_major_locator(MaxNLocator(4))
    axes.tick_params(labelsize=8)
    axes.grid(axis="x", visible=False)


def _key(computer: bool) -> list[Line2D | Patch]:
    found: list[Line2D | Patch] = [
        Line2D([], [], color=SOFT, linewidth=1.3, label="range"),
        Patch(color=_GREY, label="histogram"),
        Line2D([], [], color=BLUE, linewidth=1.7, label="median"),
        Line2D([], [], color=INK, marker="x", linestyle="", label="mean"),
    ]
    if computer:
        found.append(
            Line2D([], [], color=ORANGE, marker="o", fillstyle="none", linestyle="", markeredgewidth=1.4, label="computer")
        )
    return found


def power_figure(a: Analysis) -> Figure:
    """Power over the number of subjects, a panel for each effect."""
    table = a.table("power_curve")
    effects = list(dict.fromkeys(table["effect"]))
    with style():
        figure = Figure(figsize=(WIDTH, 3.3))
        for axes, effect in zip(figure.subplots(1, len(effects), sharey=True), effects, strict=True):
            mine = table[table["effect"] == effect]
            x = mine["subjects"].to_numpy(dtype=np.float64)
            axes.plot(x, mine["power"], color=BLUE, linewidth=1.8, label="an effect as large as observed")
            low = f"an effect at the lower end of its {100 * a.confidence:g} % interval"
            axes.plot(x, mine["power_for_least"], color=ORANGE, linewidth=1.6, linestyle=(0, (4.5, 2)), label=low)
            share = mine["fraction_of_subsets"].to_numpy(dtype=np.float64)
            axes.plot(
                x, share, "o", color=INK, markersize=4, fillstyle="none", label="fraction of random subsets of the subjects"
            )
            axes.axhline(a.power, color=SOFT, linewidth=0.9, linestyle=(0, (1.2, 1.6)), label=f"power {a.power:g}")
            axes.set_xscale("log")
            axes.set_xticks([2, 4, 8, 16, 32], ["2", "4", "8", "16", "32"])
            axes.xaxis.set_minor_formatter(NullFormatter())
            axes.set(xlabel="subjects", title=plain(effect), ylim=(0, 1.03))
        figure.axes[0].set_ylabel("probability of significance")
        legend_below(figure, figure.axes[0], 2)
        return finished(figure)
