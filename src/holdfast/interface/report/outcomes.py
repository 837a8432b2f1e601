"""Figures of the outcomes of motions: stacked bars, quantiles, and paired differences with their intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import CURVE_COLORS, WIDTH_IN, format_label, styled_figure
from holdfast.interface.report.palette import BLUE, FAINT, INK, ORANGE, PURPLE, SKY, SOFT

# Neighbours differ in hue and lightness, and are hatched if they would look alike in a black-and-white print.
OUTCOME_FILLS: tuple[tuple[str, str], ...] = ((BLUE, ""), (ORANGE, ""), ("#f0c27b", "////"), (FAINT, ""), (PURPLE, ".."))
CASE_MARKERS = ("o", "s", "D", "^", "v", "P", "X")


@dataclass(frozen=True, kw_only=True)
class Stack:
    """Group of stacked bars, one below another.

    Attributes:
        name: Name of the group.
        bars: (B,) names of its bars.
        shares: (B, K) fractions of K outcomes; each row adds up to 1.
        low, high: (B,) ends of the interval of the fraction of the first outcome.
        level: Fraction that is marked across the bars of the group; None if there is none.
    """

    name: str
    bars: Sequence[str]
    shares: FloatArray
    low: FloatArray
    high: FloatArray
    level: float | None = None


def stack_figure(
    stacks: Sequence[Stack], outcomes: Sequence[str], xlabel: str, *, level: str = "", caption: str = ""
) -> Figure:
    """Plot groups of stacked bars, from top to bottom, with the interval of the first of at most five outcomes.

    ``level`` is the legend entry of the marks of the groups, and ``caption`` the text below the figure; both may be empty.
    """
    bar_count = sum(len(stack.bars) for stack in stacks)
    with styled_figure(WIDTH_IN, 1.2 + 0.215 * bar_count + 0.12 * len(stacks)) as figure:
        axes = figure.add_subplot()
        next_position, ticks, labels, middles = 0.0, [], [], []
        for stack in stacks:
            positions = next_position + np.arange(len(stack.bars))
            bar_starts = np.zeros(len(stack.bars))
            for outcome in range(len(outcomes)):
                color, hatch = OUTCOME_FILLS[outcome]
                axes.barh(
                    positions,
                    stack.shares[:, outcome],
                    left=bar_starts,
                    height=0.8,
                    color=color,
                    hatch=hatch,
                    edgecolor="white",
                    linewidth=0.4,
                )
                bar_starts = bar_starts + stack.shares[:, outcome]
            for outline, width in (("white", 3.2), (INK, 1.4)):  # visible on light and on dark bars
                axes.hlines(positions, stack.low, stack.high, color=outline, linewidth=width)
            if stack.level is not None:
                axes.vlines(
                    stack.level, positions[0] - 0.55, positions[-1] + 0.55, color=INK, linewidth=1.4, linestyle=(0, (2, 1))
                )
            ticks += positions.tolist()
            labels += [format_label(name, 34) for name in stack.bars]
            middles.append(float(positions.mean()))
            next_position = float(positions[-1]) + 1.7
        axes.set_yticks(ticks, labels)
        axes.set(xlabel=xlabel, xlim=(0, 1), ylim=(next_position - 1.0, -0.7))
        groups = axes.secondary_yaxis("right")
        groups.set_yticks(middles, [format_label(stack.name, 24) for stack in stacks], fontweight="bold")
        groups.tick_params(axis="y", length=0)
        groups.spines["right"].set_visible(False)
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        legend_handles: list[Patch | Line2D] = [
            Patch(facecolor=color, hatch=hatch, edgecolor="white", label=name)
            for (color, hatch), name in zip(OUTCOME_FILLS, outcomes, strict=False)
        ]
        legend_handles.append(Line2D([], [], color=INK, linewidth=1.4, label=f"95 % interval of {outcomes[0]}"))
        if level:
            legend_handles.append(Line2D([], [], color=INK, linewidth=1.4, linestyle=(0, (2, 1)), label=level))
        side = "upper" if caption else "lower"
        figure.legend(handles=legend_handles, loc=f"outside {side} center", ncols=3, columnspacing=2.0)
        if caption:
            figure.supxlabel("\n".join(format_label(line, 160) for line in caption.splitlines()), fontsize=9, color=SOFT)
    return figure


@dataclass(frozen=True)
class Spread:
    """Quantity with its name and unit, and its 5, 25, 50, 75 and 95 % quantiles (B, 5) for B cases."""

    label: str
    quantiles: FloatArray


def spread_figure(names: Sequence[str], spreads: Sequence[Spread]) -> Figure:
    """Plot quantiles side by side: a thin line from 5 to 95 %, a thick one from 25 to 75 %, a dot at the median."""
    with styled_figure(WIDTH_IN, 1.25 + 0.3 * len(names)) as figure:
        all_axes = figure.subplots(1, len(spreads), squeeze=False, sharey=True)[0]
        for axes, spread in zip(all_axes, spreads, strict=True):
            _draw_quantile_bars(axes, spread)
            axes.set_yticks(range(len(names)), [format_label(name, 34) for name in names])
            axes.set_ylim(len(names) - 0.5, -0.5)
            axes.grid(axis="y", visible=False)
            axes.tick_params(axis="y", length=0)
        legend_handles = [
            Line2D([], [], color=BLUE, linewidth=1.2, label="5 to 95 %"),
            Line2D([], [], color=SKY, linewidth=6, label="25 to 75 %"),
            Line2D([], [], color=BLUE, marker="o", linestyle="", label="median"),
        ]
        figure.legend(handles=legend_handles, loc="outside lower center", ncols=3, columnspacing=2.0)
    return figure


def _draw_quantile_bars(axes: Axes, spread: Spread) -> None:
    for row, (q05, q25, q50, q75, q95) in enumerate(spread.quantiles):
        axes.hlines(row, q25, q75, color=SKY, linewidth=9)
        axes.hlines(row, q05, q95, color=BLUE, linewidth=1.2)
        axes.plot(q50, row, "o", color=BLUE, markersize=5)
    axes.set_xlabel(spread.label)
    max_quantile = float(np.nanmax(spread.quantiles, initial=0.0))
    axes.set_xlim(0, 1.08 * max_quantile if max_quantile > 1e-9 else 1.0)


@dataclass(frozen=True, kw_only=True)
class Gains:
    """Differences or fractions of one method for C cases: values (C,), and the ends (C,) of their intervals."""

    label: str
    value: FloatArray
    low: FloatArray
    high: FloatArray


def gain_figure(cases: Sequence[str], panels: Sequence[tuple[str, Sequence[Gains]]]) -> Figure:
    """Plot differences as dots with their intervals, one row per case and one panel per quantity (name with unit, values)."""
    max_gains = max(len(gains) for _, gains in panels)
    with styled_figure(WIDTH_IN, 1.3 + (0.16 + 0.19 * max_gains) * len(cases)) as figure:
        all_axes = figure.subplots(1, len(panels), squeeze=False, sharey=True)[0]
        for axes, (label, gains) in zip(all_axes, panels, strict=True):
            axes.axvline(0, color=SOFT, linewidth=1.0)
            _draw_interval_dots(axes, gains)
            axes.set_xlabel(label)
            _label_cases(axes, cases, 30)
        handles, labels = all_axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=min(max_gains, 3), columnspacing=2.0)
    return figure


def fraction_figure(cases: Sequence[str], fractions: Sequence[Gains], xlabel: str) -> Figure:
    """Plot fractions from 0 to 1 as dots with their intervals, one row per case, one colour and marker per method."""
    with styled_figure(WIDTH_IN, 1.1 + (0.16 + 0.1 * len(fractions)) * len(cases)) as figure:
        axes = figure.add_subplot()
        for row in range(1, len(cases), 2):
            axes.axhspan(row - 0.5, row + 0.5, color=FAINT, alpha=0.25, linewidth=0)
        _draw_interval_dots(axes, fractions)
        axes.set(xlabel=xlabel, xlim=(-0.01, 1.01))
        _label_cases(axes, cases, 60)
        axes.grid(axis="y", visible=False)
        handles, labels = axes.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=min(len(fractions), 5), columnspacing=2.0)
    return figure


def _draw_interval_dots(axes: Axes, gains: Sequence[Gains]) -> None:
    """Draw dots with intervals, with the methods of a case one below another."""
    for gain_index, gain in enumerate(gains):
        positions = np.arange(len(gain.value)) + (gain_index - (len(gains) - 1) / 2) * 0.6 / max(len(gains), 1)
        color = CURVE_COLORS[gain_index % len(CURVE_COLORS)]
        axes.hlines(positions, gain.low, gain.high, color=color, linewidth=1.6)
        axes.plot(
            gain.value,
            positions,
            CASE_MARKERS[gain_index % len(CASE_MARKERS)],
            color=color,
            markersize=5,
            label=format_label(gain.label, 40),
        )


def _label_cases(axes: Axes, cases: Sequence[str], max_letters: int) -> None:
    axes.set_yticks(range(len(cases)), [format_label(case, max_letters) for case in cases])
    axes.set_ylim(len(cases) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
