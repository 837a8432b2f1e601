"""Figures of an analysis: difficulty, gains, means, distributions, and statistical power."""

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

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import WIDTH_IN, format_label, legend_below, styled_figure
from holdfast.interface.report.palette import BLUE, INK, ORANGE, SOFT
from holdfast.teleop.analysis.correlations import Correlation
from holdfast.teleop.analysis.observations import MEASURE_NAMES, TrialTable
from holdfast.teleop.analysis.result import Analysis
from holdfast.teleop.trials.performance import PERFORMANCE_MEASURES

SERIES_COLORS = (BLUE, ORANGE, "#007a5e", "#a8497f", "#c58a00", "#4aa3d6")
_SERIES_MARKERS = ("o", "^", "s", "D", "v", "P")
_NEUTRAL_COLOR = "#c3c9cf"
_ROUNDING_TOLERANCE = 1e-9
_LOG_SCALE_RATIO = 30  # ratio of largest to smallest value above which the axis is logarithmic


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """Scatter plot of tasks: coordinates (T,), axis labels, correlation, and group (T,) of each task."""

    x: FloatArray
    y: FloatArray
    xlabel: str
    ylabel: str
    correlation: Correlation
    groups: NDArray[np.int64]


def scatter_figure(panels: Sequence[Scatter], names: Sequence[str]) -> Figure:
    """Draw scatter plots with one dot for each task, coloured by its group, with the names of the groups (Fig. 3)."""
    with styled_figure(WIDTH_IN * len(panels) / 3 if len(panels) < 3 else WIDTH_IN, 3.9) as figure:
        for axes, panel in zip(figure.subplots(1, len(panels), squeeze=False)[0], panels, strict=True):
            for group, name in enumerate(names):
                in_group = panel.groups == group
                axes.plot(
                    panel.x[in_group],
                    panel.y[in_group],
                    _SERIES_MARKERS[group % 6],
                    color=SERIES_COLORS[group % 6],
                    markersize=5,
                    alpha=0.85,
                    label=format_label(name),
                )
            axes.set(
                xlabel=panel.xlabel, ylabel=panel.ylabel, title=f"r = {panel.correlation.r:.3f}, {panel.correlation.n} tasks"
            )
        legend_below(figure, figure.axes[0], len(names))
    return figure


def tasks_figure(analysis: Analysis, titles: tuple[str, str]) -> Figure:
    """Draw the CPM of each task under each law, sorted by the CPM of the reference law (Fig. 4).

    The titles are those of the panels of the operators and of computer control.
    """
    table = analysis.table("tasks")
    kinds = [("median_operator", titles[0])] + ([] if analysis.computer is None else [("computer", titles[1])])
    scenarios = [condition.scenario for condition in analysis.conditions]
    with styled_figure(WIDTH_IN, 3.5 * len(kinds)) as figure:
        for axes, (kind, title) in zip(figure.subplots(len(kinds), 1, squeeze=False)[:, 0], kinds, strict=True):
            values = np.column_stack([table[f"{kind}_cpm_{scenario}"].to_numpy(dtype=np.float64) for scenario in scenarios])
            order = np.argsort(np.where(np.isnan(values[:, 0]), np.inf, values[:, 0]), kind="stable")
            values, task_numbers = values[order], table["task"].to_numpy()[order]
            positions = np.arange(len(values))
            for series in range(1, len(scenarios)):
                better = values[:, series] < values[:, 0]
                color = [SERIES_COLORS[series % 6] if is_better else _NEUTRAL_COLOR for is_better in better]
                axes.vlines(positions, values[:, 0], values[:, series], colors=color, linewidth=1.6, zorder=1)
            for series, condition in enumerate(analysis.conditions):
                label = format_label(f"CPM{condition.scenario}: {condition.law}")
                axes.plot(
                    positions,
                    values[:, series],
                    _SERIES_MARKERS[series % 6],
                    color=SERIES_COLORS[series % 6],
                    markersize=5.5,
                    label=label,
                )
            axis_end = float(np.nanmax(values, initial=0.0))
            for position in np.flatnonzero(np.isnan(values[:, 0])):
                axes.annotate(
                    "not completed", (float(position), 0.03 * axis_end), ha="center", rotation=90, fontsize=8, color=SOFT
                )
            axes.set_xticks(positions, [str(task_number) for task_number in task_numbers])
            axes.set(
                xlabel="task, sorted by its CPM under the reference law",
                ylabel="CPM",
                title=title,
                ylim=(0, 1.08 * (axis_end or 1)),
            )
            axes.grid(axis="x", visible=False)
        legend_below(figure, figure.axes[0], len(scenarios))
    return figure


def draw_cell_means(analysis: Analysis) -> Figure:
    """Draw the mean of each law and group with its interval, and the means of every subject as dots."""
    from scipy import stats

    values, names = analysis.cells.values, analysis.cells.groups
    with styled_figure(0.72 * WIDTH_IN, 3.9) as figure:
        axes = figure.add_subplot()
        positions = np.arange(len(names))
        for series, law in enumerate(analysis.cells.laws):
            shift = 0.16 * (series - (len(analysis.cells.laws) - 1) / 2)
            subject_values = values[:, series]
            jitter = np.linspace(-0.035, 0.035, len(subject_values))[:, None]
            axes.plot(
                np.ravel(positions + shift + jitter),
                subject_values.ravel(),
                ".",
                color=SERIES_COLORS[series % 6],
                alpha=0.3,
                markersize=4,
                zorder=1,
            )
            count = np.isfinite(subject_values).sum(axis=0)
            half_width = (
                stats.t.ppf(0.5 + analysis.confidence / 2, count - 1)
                * np.nanstd(subject_values, axis=0, ddof=1)
                / np.sqrt(count)
            )
            axes.errorbar(
                positions + shift,
                np.nanmean(subject_values, axis=0),
                half_width,
                color=SERIES_COLORS[series % 6],
                marker=_SERIES_MARKERS[series % 6],
                markersize=6.5,
                capsize=4,
                linewidth=1.4,
                label=format_label(law),
            )
        axes.set_xticks(
            positions,
            [f"{format_label(name)}\n({size} tasks)" for name, size in zip(names, analysis.groups.sizes, strict=True)],
        )
        axes.set(ylabel="mean CPM of a subject, failed arm", ylim=(0, None))
        axes.grid(axis="x", visible=False)
        legend_below(figure, axes, len(analysis.cells.laws))
    return figure


def measures_figure(
    values: Sequence[Sequence[FloatArray]], computer: Sequence[FloatArray] | None, scenarios: Sequence[int]
) -> Figure:
    """Draw CPM and each measure by scenario: range, histogram, mean, median, and value under computer control (Figs. 5 to 7).

    Args:
        values: Values of the operators for CPM and each measure (13, or 12 without ratings), and for each scenario.
        computer: Value under computer control in each scenario, for CPM and M1 to M11; None if not available.
        scenarios: Numbers of the scenarios.
    """
    columns = 5
    row_count = -(-len(values) // columns)
    height = 2.2 * row_count + 0.9
    # Fixed layout: an automatic layout of this many panels would take most of the time.
    with styled_figure(WIDTH_IN, height) as figure:
        figure.set_layout_engine("none")
        layout = {"left": 0.05, "right": 0.995, "top": 1 - 0.4 / height, "bottom": 0.8 / height, "wspace": 0.34, "hspace": 0.46}
        panels = figure.subplots(row_count, columns, squeeze=False, gridspec_kw=layout).ravel()
        for measure, axes in enumerate(panels):
            if measure >= len(values):
                axes.set_visible(False)
                continue
            factor = 1.0 if measure == 0 else label_measure(measure - 1)[1]
            computer_values = None if computer is None or measure >= len(computer) else factor * computer[measure]
            _draw_distributions(
                axes, [factor * scenario_values for scenario_values in values[measure]], computer_values, scenarios
            )
            # Titles are wrapped, because the panels are narrow and neighbouring titles must not touch.
            axes.set_title(fill("CPM" if measure == 0 else label_measure(measure - 1)[0], 22), fontsize=8, pad=4)
        for axes in panels[max(0, len(values) - columns) : len(values)]:
            axes.set_xlabel("scenario")
        figure.legend(handles=_legend_handles(computer is not None), loc="lower center", ncols=5, columnspacing=2.0)
    return figure


def list_measure_values(observed: TrialTable, tasks: Sequence[int] | slice = slice(None)) -> list[list[FloatArray]]:
    """List the values of CPM and each measure, for each scenario, over all subjects and the tasks (indices from 0)."""
    measures = np.concatenate([observed.cpm[..., None], observed.measures], axis=-1)[:, tasks]
    return [
        [measures[:, :, scenario, measure].ravel() for scenario in range(measures.shape[2])]
        for measure in range(len(MEASURE_NAMES) + observed.has_ratings)
    ]


def label_measure(measure: int) -> tuple[str, float]:
    """Return the name of a measure (index from 0) with its display unit, and the factor that converts its values."""
    definition = PERFORMANCE_MEASURES[measure]
    if definition.name == "M12":
        return "M12 rating", 1.0
    if "direction" in definition.about:
        return f"{definition.name} {definition.about}, °", float(np.degrees(1.0))
    return f"{definition.name} {definition.about}{'' if definition.unit == '1' else f', {definition.unit}'}", 1.0


def _draw_distributions(
    axes: Axes, values: Sequence[FloatArray], computer: FloatArray | None, scenarios: Sequence[int]
) -> None:
    finite_values = [np.where(np.abs(sample) < _ROUNDING_TOLERANCE, 0.0, sample)[np.isfinite(sample)] for sample in values]
    computer_values = (
        np.full(len(finite_values), np.nan)
        if computer is None
        else np.where(np.abs(computer) < _ROUNDING_TOLERANCE, 0.0, computer)
    )
    everything = np.concatenate([*finite_values, computer_values[np.isfinite(computer_values)]])
    if not everything.size:
        axes.annotate("no trial reached the target", (0.5, 0.5), xycoords="axes fraction", ha="center", color=SOFT)
        return
    lower, upper = float(everything.min()), float(everything.max())
    is_log = lower > 0 and upper > _LOG_SCALE_RATIO * lower
    if upper - lower <= 1e-9 * max(abs(upper), 1.0):
        lower, upper = lower - 0.5, upper + 0.5
    edges = np.geomspace(lower, upper, 17) if is_log else np.linspace(lower, upper, 17)
    for position, sample in enumerate(finite_values, start=1):
        if sample.size:
            count, _ = np.histogram(np.clip(sample, lower, upper), edges)
            width = 0.42 * count / count.max()
            axes.fill_betweenx(
                np.repeat(edges, 2)[1:-1], position, position + np.repeat(width, 2), color=_NEUTRAL_COLOR, linewidth=0, zorder=1
            )
            axes.vlines(position, sample.min(), sample.max(), color=SOFT, linewidth=1.3, zorder=2)
            axes.hlines(np.median(sample), position - 0.17, position + 0.42, color=BLUE, linewidth=1.7, zorder=3)
            axes.plot([position], [sample.mean()], "x", color=INK, markersize=5, markeredgewidth=1.2, zorder=4)
    axes.plot(
        np.arange(1, len(finite_values) + 1),
        computer_values,
        "o",
        color=ORANGE,
        markersize=5.2,
        fillstyle="none",
        markeredgewidth=1.4,
        zorder=5,
    )
    axes.set_xticks(range(1, len(finite_values) + 1), [str(scenario) for scenario in scenarios])
    axes.set_xlim(0.6, len(finite_values) + 0.6)
    if is_log:
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 3), numticks=6))
        axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.minorticks_off()
    else:
        axes.yaxis.set_major_locator(MaxNLocator(4))
    axes.tick_params(labelsize=8)
    axes.grid(axis="x", visible=False)


def _legend_handles(computer: bool) -> list[Line2D | Patch]:
    handles: list[Line2D | Patch] = [
        Line2D([], [], color=SOFT, linewidth=1.3, label="range"),
        Patch(color=_NEUTRAL_COLOR, label="histogram"),
        Line2D([], [], color=BLUE, linewidth=1.7, label="median"),
        Line2D([], [], color=INK, marker="x", linestyle="", label="mean"),
    ]
    if computer:
        handles.append(
            Line2D([], [], color=ORANGE, marker="o", fillstyle="none", linestyle="", markeredgewidth=1.4, label="computer")
        )
    return handles


def draw_power(analysis: Analysis) -> Figure:
    """Draw the statistical power against the number of subjects, one panel for each effect."""
    table = analysis.table("power_curve")
    effects = list(dict.fromkeys(table["effect"]))
    with styled_figure(WIDTH_IN, 3.3) as figure:
        for axes, effect in zip(figure.subplots(1, len(effects), sharey=True), effects, strict=True):
            effect_rows = table[table["effect"] == effect]
            subject_counts = effect_rows["subjects"].to_numpy(dtype=np.float64)
            axes.plot(subject_counts, effect_rows["power"], color=BLUE, linewidth=1.8, label="an effect as large as observed")
            lower_label = f"an effect at the lower end of its {100 * analysis.confidence:g} % interval"
            axes.plot(
                subject_counts,
                effect_rows["power_for_least"],
                color=ORANGE,
                linewidth=1.6,
                linestyle=(0, (4.5, 2)),
                label=lower_label,
            )
            subset_fraction = effect_rows["fraction_of_subsets"].to_numpy(dtype=np.float64)
            axes.plot(
                subject_counts,
                subset_fraction,
                "o",
                color=INK,
                markersize=4,
                fillstyle="none",
                label="fraction of random subsets of the subjects",
            )
            axes.axhline(
                analysis.power, color=SOFT, linewidth=0.9, linestyle=(0, (1.2, 1.6)), label=f"power {analysis.power:g}"
            )
            axes.set_xscale("log")
            axes.set_xticks([2, 4, 8, 16, 32], ["2", "4", "8", "16", "32"])
            axes.xaxis.set_minor_formatter(NullFormatter())
            axes.set(xlabel="subjects", title=format_label(effect), ylim=(0, 1.03))
        figure.axes[0].set_ylabel("probability of significance")
        legend_below(figure, figure.axes[0], 2)
    return figure
