"""Figures of how many trials ended how: stacked bars, quantiles, and paired differences with their intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from holdfast.report.figures import BLUE, COLORS, FAINT, INK, ORANGE, PURPLE, SKY, SOFT, WIDTH, finished, plain, style

Array = NDArray[np.float64]

# Light to dark as well as by hue, and hatched where two neighbours would print alike.
FILLS: tuple[tuple[str, str], ...] = ((BLUE, ""), (ORANGE, ""), ("#f0c27b", "////"), (FAINT, ""), (PURPLE, ".."))
MARKERS = ("o", "s", "D", "^", "v", "P", "X")


@dataclass(frozen=True, kw_only=True)
class Stack:
    """Bars of one group, one below the other, each stacked from shares.

    Attributes:
        name: Of the group.
        bars: Names of its bars.
        shares: (B, K) shares of K outcomes; a row adds up to 1.
        low, high: (B,) ends of the interval of the first outcome's share.
        level: A share marked across the bars of the group, or None.
    """

    name: str
    bars: Sequence[str]
    shares: Array
    low: Array
    high: Array
    level: float | None = None


def stack_figure(
    stacks: Sequence[Stack], outcomes: Sequence[str], xlabel: str, *, level: str = "", caption: str = ""
) -> Figure:
    """Groups of stacked bars with the interval of the first outcome.

    Args:
        stacks: From the top.
        outcomes: (K,) what the parts are, up to five.
        xlabel: What the shares are of.
        level: What the mark of a group says.
        caption: What was computed, a few lines.
    """
    total = sum(len(s.bars) for s in stacks)
    with style():
        figure = Figure(figsize=(WIDTH, 1.2 + 0.215 * total + 0.12 * len(stacks)))
        axes = figure.add_subplot()
        y, ticks, labels, middles = 0.0, [], [], []
        for s in stacks:
            places = y + np.arange(len(s.bars))
            left = np.zeros(len(s.bars))
            for k in range(len(outcomes)):
                color, hatch = FILLS[k]
                axes.barh(
                    places, s.shares[:, k], left=left, height=0.8, color=color, hatch=hatch, edgecolor="white", linewidth=0.4
                )
                left = left + s.shares[:, k]
            for outline, width in (("white", 3.2), (INK, 1.4)):  # seen on light and on dark
                axes.hlines(places, s.low, s.high, color=outline, linewidth=width)
            if s.level is not None:
                axes.vlines(s.level, places[0] - 0.55, places[-1] + 0.55, color=INK, linewidth=1.4, linestyle=(0, (2, 1)))
            ticks += places.tolist()
            labels += [plain(name, 34) for name in s.bars]
            middles.append(float(places.mean()))
            y = float(places[-1]) + 1.7
        axes.set_yticks(ticks, labels)
        axes.set(xlabel=xlabel, xlim=(0, 1), ylim=(y - 1.0, -0.7))
        groups = axes.secondary_yaxis("right")
        groups.set_yticks(middles, [plain(s.name, 24) for s in stacks], fontweight="bold")
        groups.tick_params(axis="y", length=0)
        groups.spines["right"].set_visible(False)
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
        axes.spines["left"].set_visible(False)
        keys: list[Patch | Line2D] = [
            Patch(facecolor=color, hatch=hatch, edgecolor="white", label=name)
            for (color, hatch), name in zip(FILLS, outcomes, strict=False)
        ]
        keys.append(Line2D([], [], color=INK, linewidth=1.4, label=f"95 % interval of {outcomes[0]}"))
        if level:
            keys.append(Line2D([], [], color=INK, linewidth=1.4, linestyle=(0, (2, 1)), label=level))
        place: Literal["outside upper center", "outside lower center"] = (
            "outside upper center" if caption else "outside lower center"
        )
        figure.legend(handles=keys, loc=place, ncols=3, columnspacing=2.0)
        if caption:
            figure.supxlabel("\n".join(plain(line, 160) for line in caption.splitlines()), fontsize=9, color=SOFT)
        return finished(figure)


@dataclass(frozen=True)
class Spread:
    """A quantity of several things: its name with the unit, and quantiles (B, 5), 5, 25, 50, 75 and 95 %."""

    label: str
    quantiles: Array
    log: bool = False


def spread_figure(names: Sequence[str], spreads: Sequence[Spread]) -> Figure:
    """Quantiles side by side: a thin line from 5 to 95 %, a thick one from 25 to 75 %, a dot at the median."""
    with style():
        figure = Figure(figsize=(WIDTH, 1.25 + 0.3 * len(names)))
        every = figure.subplots(1, len(spreads), squeeze=False, sharey=True)[0]
        for axes, s in zip(every, spreads, strict=True):
            _draw_spread(axes, s)
            axes.set_yticks(range(len(names)), [plain(n, 34) for n in names])
            axes.set_ylim(len(names) - 0.5, -0.5)
            axes.grid(axis="y", visible=False)
            axes.tick_params(axis="y", length=0)
        keys = [
            Line2D([], [], color=BLUE, linewidth=1.2, label="5 to 95 %"),
            Line2D([], [], color=SKY, linewidth=6, label="25 to 75 %"),
            Line2D([], [], color=BLUE, marker="o", linestyle="", label="median"),
        ]
        figure.legend(handles=keys, loc="outside lower center", ncols=3, columnspacing=2.0)
        return finished(figure)


def _draw_spread(axes: Axes, s: Spread) -> None:
    for row, (q05, q25, q50, q75, q95) in enumerate(s.quantiles):
        axes.hlines(row, q25, q75, color=SKY, linewidth=9)
        axes.hlines(row, q05, q95, color=BLUE, linewidth=1.2)
        axes.plot(q50, row, "o", color=BLUE, markersize=5)
    axes.set_xlabel(s.label)
    top = float(np.nanmax(s.quantiles, initial=0.0))
    if s.log:
        axes.set_xscale("log")
    else:
        axes.set_xlim(0, 1.08 * top if top > 1e-9 else 1.0)


@dataclass(frozen=True, kw_only=True)
class Gains:
    """Differences or shares of one thing over several cases: values, and ends of their intervals, (C,) each."""

    label: str
    value: Array
    low: Array
    high: Array


def gain_figure(cases: Sequence[str], panels: Sequence[tuple[str, Sequence[Gains]]]) -> Figure:
    """Differences as dots with their intervals, a panel per quantity; its name with the unit is under the axis."""
    most = max(len(gains) for _, gains in panels)
    with style():
        figure = Figure(figsize=(WIDTH, 1.3 + (0.16 + 0.19 * most) * len(cases)))
        every = figure.subplots(1, len(panels), squeeze=False, sharey=True)[0]
        for axes, (label, gains) in zip(every, panels, strict=True):
            axes.axvline(0, color=SOFT, linewidth=1.0)
            _dots(axes, gains)
            axes.set_xlabel(label)
            _rows(axes, cases, 30)
        handles, labels = every[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=min(most, 3), columnspacing=2.0)
        return finished(figure)


def share_figure(cases: Sequence[str], shares: Sequence[Gains], xlabel: str) -> Figure:
    """Shares of several things over several cases, from 0 to 1: dots with their intervals, one colour and shape per thing."""
    with style():
        figure = Figure(figsize=(WIDTH, 1.1 + (0.16 + 0.1 * len(shares)) * len(cases)))
        axes = figure.add_subplot()
        for row in range(1, len(cases), 2):
            axes.axhspan(row - 0.5, row + 0.5, color=FAINT, alpha=0.25, linewidth=0)
        _dots(axes, shares)
        axes.set(xlabel=xlabel, xlim=(-0.01, 1.01))
        _rows(axes, cases, 60)
        axes.grid(axis="y", visible=False)
        handles, labels = axes.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=min(len(shares), 5), columnspacing=2.0)
        return finished(figure)


def _dots(axes: Axes, shown: Sequence[Gains]) -> None:
    """The things of a case one below the other."""
    for k, g in enumerate(shown):
        places = np.arange(len(g.value)) + (k - (len(shown) - 1) / 2) * 0.6 / max(len(shown), 1)
        color = COLORS[k % len(COLORS)]
        axes.hlines(places, g.low, g.high, color=color, linewidth=1.6)
        axes.plot(g.value, places, MARKERS[k % len(MARKERS)], color=color, markersize=5, label=plain(g.label, 40))


def _rows(axes: Axes, cases: Sequence[str], most: int) -> None:
    axes.set_yticks(range(len(cases)), [plain(c, most) for c in cases])
    axes.set_ylim(len(cases) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
