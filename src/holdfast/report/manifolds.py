"""Figures of what an arm reaches: joint values along self-motion manifolds, and maps of a region of the workspace."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from holdfast.report.figures import BLUE, INK, ORANGE, PALE, SKY, SOFT, WIDTH, finished, plain, style
from holdfast.report.views import View

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]

_GAP = 0.04  # of the whole length, between two curves


@dataclass(frozen=True)
class JointPanel:
    """One joint.

    Attributes:
        label: Name and unit.
        arcs: The values that it takes.
        whole: The values between which it can be.
    """

    label: str
    arcs: Sequence[tuple[float, float]]
    whole: tuple[float, float]


def self_motion_figure(
    joints: Sequence[JointPanel],
    curves: Sequence[tuple[Array, Array]],
    chains: Array,
    views: Sequence[View],
    caption: str,
) -> Figure:
    """A row for each joint: its values along the curves one after the other, and its arcs as bands; beside it the arm.

    Args:
        joints: From base to tip.
        curves: Arc length (K,) and joint values (K, n) in the units of the panels; none if the manifold is not made of curves.
        chains: (C, K, 3) the arm in several configurations, m.
        views: How it is seen.
        caption: One line.
    """
    with style():
        height = max(0.86 * len(joints) + 0.9, 3.4 * len(views) if len(views) > 1 else 3.9)
        figure = Figure(figsize=(WIDTH, height))
        left, right = np.asarray(figure.subfigures(1, 2, width_ratios=(1.25, 1.0)))
        rows = np.atleast_1d(left.subplots(len(joints), 1, sharex=True))
        total = sum(float(s[-1]) for s, _ in curves) or 1.0
        for k, (axes, panel) in enumerate(zip(rows, joints, strict=True)):
            _draw_joint(axes, panel, k, curves, total)
        if not len(curves):
            rows[-1].set_xticks([])
        rows[-1].set_xlabel("length along the curves, one after the other, rad" if len(curves) else "")
        rows[0].set_title("Values that keep the target within reach" if not len(curves) else "Along the self-motion manifold")
        panels = np.atleast_1d(right.subplots(len(views), 1)) if views else ()
        for axes, view in zip(panels, views, strict=True):
            _draw_arm(axes, chains @ np.stack([view.right, view.up]).T, view)
        banded = any(panel.arcs for panel in joints)
        handles = [
            *([Patch(facecolor=SKY, alpha=0.55, label="a lock here keeps the target")] if banded else []),
            *([Line2D([], [], color=BLUE, linewidth=1.6, label="on the curve")] if len(curves) else []),
        ]
        figure.legend(handles=handles, loc="outside upper right", ncols=2)
        figure.supxlabel(plain(caption, 220), fontsize=9, color=SOFT)
        return finished(figure)


def _draw_joint(axes: Axes, panel: JointPanel, k: int, curves: Sequence[tuple[Array, Array]], total: float) -> None:
    low, high = panel.whole
    turn = high - low
    for a, b in panel.arcs:
        # An arc that runs on beyond the end of a circle goes on at its beginning.
        for shift in (0.0, -turn):
            top, bottom = min(b + shift, high), max(a + shift, low)
            if top >= bottom:
                axes.axhspan(bottom - 0.004 * turn, top + 0.004 * turn, color=SKY, alpha=0.55, linewidth=0)
    at = 0.0
    for length, values in curves:
        x, y = at + length, values[:, k]
        wrapped = (y - low) % turn + low if (y < low - 1e-6 * turn).any() or (y > high + 1e-6 * turn).any() else y
        jumps = np.flatnonzero(np.abs(np.diff(wrapped)) > turn / 2) + 1
        for part in np.split(np.arange(x.size), jumps):
            axes.plot(x[part], wrapped[part], color=BLUE, linewidth=1.6)
        at += float(length[-1]) + _GAP * total
    axes.set_ylim(low - 0.03 * turn, high + 0.03 * turn)
    axes.set_ylabel(plain(panel.label, 26), rotation=0, ha="right", va="center")
    axes.yaxis.set_major_locator(MaxNLocator(3, steps=[1, 3, 6, 9, 10] if turn > 100 else None))
    axes.grid(axis="x", visible=False)
    if curves:
        axes.set_xlim(-0.01 * total, at - _GAP * total + 0.01 * total)


def _draw_arm(axes: Axes, chains: Array, view: View) -> None:
    for shade, chain in zip(np.linspace(0.25, 1.0, len(chains)), chains, strict=True):
        axes.plot(*chain.T, color=INK, alpha=0.25 + 0.55 * shade, linewidth=1.2 + 0.9 * shade, solid_joinstyle="round")
        axes.plot(*chain[1:-1].T, "o", color="white", markeredgecolor=INK, markeredgewidth=1.0, markersize=4, zorder=3)
    axes.plot(*chains[0, 0], marker="s", color=INK, markersize=8)
    axes.plot(*chains[-1, -1], marker="D", color=ORANGE, markeredgecolor="white", markersize=7, zorder=4)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.1)
    axes.set(xlabel=view.names[0], ylabel=view.names[1], title=view.title)


@dataclass(frozen=True)
class RegionMap:
    """Points (N, 2) of a view, m, in three nested sets.

    Attributes:
        points: Where.
        view: How they are seen.
        healthy, within, inside: (N,) reached by the healthy arm; within its artificial limits; and after any lock.
        grid: Points along each edge, if they are a square grid, row by row from below; None for a sample.
    """

    points: Array
    view: View
    healthy: Bools
    within: Bools
    inside: Bools
    grid: int | None


def region_figure(
    maps: Sequence[RegionMap], bars: Sequence[tuple[str, float]], unit: str, error: Array, caption: str
) -> Figure:
    """Maps of a region inside what the healthy arm reaches, and bars of the sizes.

    Args:
        maps: One panel each.
        bars: Names and sizes, the region last.
        unit: Of the sizes.
        error: (2,) how far the size of the region may lie below and above.
        caption: One line.
    """
    with style():
        figure = Figure(figsize=(WIDTH, 4.6))
        panels = figure.subplots(1, len(maps) + 1, width_ratios=[1.0] * len(maps) + [0.9 if len(maps) > 1 else 1.1])
        for axes, view in zip(panels, maps, strict=False):
            _draw_map(axes, view)
        axes = panels[-1]
        rows = np.arange(len(bars))
        colors = [PALE, *[SKY] * (len(bars) - 2), BLUE]
        sizes = [size for _, size in bars]
        axes.barh(rows, sizes, height=0.64, color=colors)
        axes.errorbar(sizes[-1], rows[-1], xerr=error.reshape(2, 1), color=INK, capsize=3, linewidth=1)
        for row, size in zip(rows, sizes, strict=True):
            shift = error[1] if row == rows[-1] else 0.0
            axes.annotate(f"{size:.3g}", (size + shift, row), (4, 0), textcoords="offset points", va="center", fontsize=9)
        axes.set_yticks(rows, [plain(name, 30) for name, _ in bars])
        axes.set(xlabel=unit, xlim=(0, max(sizes) * 1.2 or 1.0), ylim=(len(bars) - 0.45, -0.55), title="Size")
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
        keys = ((PALE, "healthy, its own limits"), (SKY, "healthy, artificial limits"), (BLUE, "also after any lock"))
        handles = [Patch(facecolor=c, label=t) for c, t in keys]
        figure.legend(handles=handles, loc="outside upper left", ncols=3)
        figure.supxlabel(plain(caption, 220), fontsize=9, color=SOFT)
        return finished(figure)


def _draw_map(axes: Axes, region: RegionMap) -> None:
    sets = ((region.healthy, PALE), (region.within, SKY), (region.inside, BLUE))
    if region.grid is not None:
        size = (region.grid, region.grid)
        x, y = (region.points[:, k].reshape(size) for k in (0, 1))
        for chosen, color in sets:
            if chosen.any():
                axes.contourf(x, y, chosen.reshape(size).astype(float), levels=[0.5, 1.5], colors=[color])
    else:
        for chosen, color in sets:
            axes.scatter(region.points[chosen, 0], region.points[chosen, 1], s=9, c=color, linewidths=0)
    axes.plot(0, 0, marker="s", color=INK, markersize=6)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel=region.view.names[0], ylabel=region.view.names[1], title=region.view.title)
