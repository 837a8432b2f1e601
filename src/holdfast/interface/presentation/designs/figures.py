"""Figures of a design search: the Pareto front of index quantile and reach, and the arm before and after."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.arm.view import choose_views, find_box_corners, find_middle_of_limits, reach_center
from holdfast.interface.report.palette import BLUE, INK, ORANGE, SKY, SOFT
from holdfast.kinematics.regions.region import Region
from holdfast.model.arm.model import Arm
from holdfast.model.arm.task import Task


def draw_pareto_front(
    reach: FloatArray,
    quantiles: FloatArray,
    front: Sequence[int],
    best: int,
    baseline: tuple[float, float] | None,
    label: str,
    bound: float | None,
) -> report.Figure:
    """Draw every design by its reach and its index quantile, with the Pareto front.

    Args:
        reach: (D,) reach of each design, m.
        quantiles: (D,) lower quantile of the index of each design.
        front: Indices, from 0, of the designs of the Pareto front, sorted by reach.
        best: Index, from 0, of the best design.
        baseline: Reach (m) and index quantile of the baseline arm; None if not known.
        label: Label of the axis of the quantiles.
        bound: Upper bound of the index; drawn only if it is near the values. None if not known.
    """
    with report.styled_figure(report.WIDTH_IN, 4.6) as figure:
        axes = figure.add_subplot()
        axes.scatter(reach, quantiles, s=14, color=SKY, linewidths=0, rasterized=True)
        front_rows = np.asarray(front, dtype=int)
        axes.step(reach[front_rows], quantiles[front_rows], where="pre", color=BLUE, linewidth=1.4, zorder=2.5)
        axes.plot(reach[front_rows], quantiles[front_rows], "o", color=BLUE, markersize=5, zorder=2.6)
        if baseline is not None:
            axes.plot(*baseline, "s", color=ORANGE, markeredgecolor="white", markersize=10, zorder=3)
        axes.plot(reach[best], quantiles[best], "*", color=INK, markeredgecolor="white", markersize=17, zorder=3.1)
        largest_value = max(float(quantiles.max(initial=0.0)), 0.0 if baseline is None else baseline[1])
        if bound is not None and bound < 1.6 * largest_value:
            axes.axhline(bound, color=SOFT, linewidth=1.3, linestyle=(0, (1.2, 1.6)))
            axes.annotate(
                f"no configuration can exceed {bound:.3f}",
                (0.995, bound),
                (0, 4),
                xycoords=("axes fraction", "data"),
                textcoords="offset points",
                ha="right",
                color=SOFT,
            )
        axes.set(xlabel="reach, m", ylabel=label)
        axes.set_ylim(bottom=0.0)
        axes.margins(y=0.1)
        handles = [
            report.Line2D([], [], marker="o", color=SKY, linestyle="", markersize=5, label=f"{len(reach):,} designs"),
            report.Line2D([], [], marker="o", color=BLUE, markersize=5, label="Pareto front"),
            report.Line2D([], [], marker="s", color=ORANGE, linestyle="", markersize=8, label="baseline arm"),
            report.Line2D([], [], marker="*", color=INK, linestyle="", markersize=13, label="best design"),
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=4, columnspacing=2.0)
    return figure


def draw_before_and_after(baseline: Arm, best: Arm, task: Task, region: Region, seed: int) -> report.Figure:
    """Draw the baseline arm and the best one on the same scale, with the tool at the region centre if the arm reaches it."""
    scenes, box = [], find_box_corners(region)
    for arm in (baseline, best):
        q = reach_center(arm, task, region, seed, 50)
        chain = arm.frames(find_middle_of_limits(arm) if q is None else q)[:, :3, 3]
        scenes.append(report.Scene(chain=chain, square=arm.prismatic, box=box))
    view = choose_views(baseline, np.concatenate([scene.chain for scene in scenes]))[0]
    # Both panels show the same part of the world.
    extent = report.Scene(np.concatenate([scene.extent for scene in scenes])).extent
    with report.styled_figure(report.WIDTH_IN, 5.4) as figure:
        panels: Sequence[report.Axes] = figure.subplots(1, 2)
        spans, height = report.scenes.fit_view_spans(extent, [view], 4.4, 2.2, 4.6)
        figure.set_figheight(height + 0.9)
        for axes, scene, title in zip(panels, scenes, ("before: " + baseline.name, "after: " + best.name), strict=True):
            report.scenes.draw_view(axes, scene, view, report.Scale(0.0, 1.0), 1.0, spans, 4.4, extent.mean(axis=0))
            axes.set_title(report.format_label(title, 44))
    return figure


def draw_parameters(
    names: Sequence[str], values: FloatArray, quantiles: FloatArray, baseline: tuple[FloatArray, float] | None, label: str
) -> report.Figure:
    """Draw the index quantile against each parameter, one panel for each parameter.

    Args:
        names: (k,) names of the parameters, with their units.
        values: (D, k) values of the parameters, in the units of ``names``.
        quantiles: (D,) lower quantile of the index, or another value, of each design.
        baseline: Values (k,) and quantile of the baseline arm; None if not known.
        label: Label of the axis of the quantiles.
    """
    column_count = 2 if len(names) == 4 else min(3, len(names))
    row_count = -(-len(names) // column_count)
    with report.styled_figure(report.WIDTH_IN, 2.5 * row_count + 0.5) as figure:
        panels = figure.subplots(row_count, column_count, squeeze=False, sharey=True)
        for index, axes in enumerate(panels.flat):
            if index >= len(names):
                axes.set_axis_off()
                continue
            axes.scatter(values[:, index], quantiles, s=9, color=BLUE, alpha=0.45, linewidths=0, rasterized=True)
            if baseline is not None:
                axes.plot(baseline[0][index], baseline[1], "s", color=ORANGE, markeredgecolor="white", markersize=8, zorder=3)
            axes.set(xlabel=report.format_label(names[index]), ylim=(0, None))
        figure.supylabel(label, fontsize=9.5)
        handles = [
            report.Line2D([], [], marker="o", color=BLUE, linestyle="", markersize=5, label="design"),
            report.Line2D([], [], marker="s", color=ORANGE, linestyle="", markersize=8, label="baseline arm"),
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=2, columnspacing=2.0)
    return figure
