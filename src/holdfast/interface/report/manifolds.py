"""Figures of reachability: joint values along self-motion manifolds, and maps of a region of the workspace."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from holdfast.core.typing import BoolArray, FloatArray
from holdfast.interface.report.figures import WIDTH_IN, format_label, styled_figure
from holdfast.interface.report.motions import draw_chain, show_view
from holdfast.interface.report.palette import BLUE, EMPTY_COLOR, INK, ORANGE, SKY, SOFT
from holdfast.interface.report.views import View

_CURVE_GAP_FRACTION = 0.04  # gap between two curves, as a fraction of the total length


@dataclass(frozen=True)
class JointPanel:
    """Joint of a self-motion figure.

    Attributes:
        label: Name and unit.
        arcs: Intervals of the values that the joint takes, in this unit.
        value_range: Lower and upper limit of the joint, in this unit.
    """

    label: str
    arcs: Sequence[tuple[float, float]]
    value_range: tuple[float, float]


def self_motion_figure(
    joints: Sequence[JointPanel],
    curves: Sequence[tuple[FloatArray, FloatArray]],
    chains: FloatArray,
    views: Sequence[View],
    caption: str,
) -> Figure:
    """Plot the arm, and for each joint its values along consecutive curves with its arcs as bands.

    Args:
        joints: Joints from base to tip.
        curves: Arc length (K,), rad, and joint values (K, n), in the units of the panels, of each curve; empty if the
            manifold has a higher dimension.
        chains: (C, K, 3) base, joint, and tool positions in C configurations, m.
        views: Projections in which the arm is drawn.
        caption: Line below the figure.
    """
    height = max(0.86 * len(joints) + 0.9, 3.4 * len(views) if len(views) > 1 else 3.9)
    with styled_figure(WIDTH_IN, height) as figure:
        joint_figure, arm_figure = np.asarray(figure.subfigures(1, 2, width_ratios=(1.25, 1.0)))
        joint_axes = np.atleast_1d(joint_figure.subplots(len(joints), 1, sharex=True))
        total_length = sum(float(lengths[-1]) for lengths, _ in curves) or 1.0
        for joint, (axes, panel) in enumerate(zip(joint_axes, joints, strict=True)):
            _draw_joint(axes, panel, joint, curves, total_length)
        if not len(curves):
            joint_axes[-1].set_xticks([])
        joint_axes[-1].set_xlabel("length along the curves, one after the other, rad" if len(curves) else "")
        joint_axes[0].set_title(
            "Values that keep the target within reach" if not len(curves) else "Along the self-motion manifold"
        )
        panels = np.atleast_1d(arm_figure.subplots(len(views), 1)) if views else ()
        for axes, view in zip(panels, views, strict=True):
            for index, shade in enumerate(np.linspace(0.25, 1.0, len(chains))):
                draw_chain(
                    axes,
                    view.project(chains[index]),
                    linewidth=1.2 + 0.9 * shade,
                    node_size=4.0,
                    tool_color=ORANGE if index == len(chains) - 1 else "",
                    alpha=0.25 + 0.55 * shade,
                )
            show_view(axes, view, 0.1)
        has_bands = any(panel.arcs for panel in joints)
        handles = [
            *([Patch(facecolor=SKY, alpha=0.55, label="lock keeps the target within reach")] if has_bands else []),
            *([Line2D([], [], color=BLUE, linewidth=1.6, label="on the curve")] if len(curves) else []),
        ]
        figure.legend(handles=handles, loc="outside upper right", ncols=2)
        figure.supxlabel(format_label(caption, 220), fontsize=9, color=SOFT)
    return figure


def _draw_joint(
    axes: Axes, panel: JointPanel, joint: int, curves: Sequence[tuple[FloatArray, FloatArray]], total_length: float
) -> None:
    lower, upper = panel.value_range
    period = upper - lower
    for arc_start, arc_end in panel.arcs:
        # An arc that exceeds the upper limit of an unlimited joint continues at the lower limit.
        for shift in (0.0, -period):
            band_top, band_bottom = min(arc_end + shift, upper), max(arc_start + shift, lower)
            if band_top >= band_bottom:
                axes.axhspan(band_bottom - 0.004 * period, band_top + 0.004 * period, color=SKY, alpha=0.55, linewidth=0)
    curve_start = 0.0
    for length, values in curves:
        arc_length, joint_values = curve_start + length, values[:, joint]
        wrapped = (
            (joint_values - lower) % period + lower
            if (joint_values < lower - 1e-6 * period).any() or (joint_values > upper + 1e-6 * period).any()
            else joint_values
        )
        jumps = np.flatnonzero(np.abs(np.diff(wrapped)) > period / 2) + 1
        for piece in np.split(np.arange(arc_length.size), jumps):
            axes.plot(arc_length[piece], wrapped[piece], color=BLUE, linewidth=1.6)
        curve_start += float(length[-1]) + _CURVE_GAP_FRACTION * total_length
    axes.set_ylim(lower - 0.03 * period, upper + 0.03 * period)
    axes.set_ylabel(format_label(panel.label, 26), rotation=0, ha="right", va="center")
    axes.yaxis.set_major_locator(MaxNLocator(3, steps=[1, 3, 6, 9, 10] if period > 100 else None))
    axes.grid(axis="x", visible=False)
    if curves:
        axes.set_xlim(-0.01 * total_length, curve_start - _CURVE_GAP_FRACTION * total_length + 0.01 * total_length)


@dataclass(frozen=True)
class RegionMap:
    """Points (N, 2) of a view, m, in three nested sets.

    Attributes:
        points: (N, 2) projected points, m.
        view: Projection of the points.
        healthy_reach, limited_reach, lock_tolerant: (N,) flags of points reached by the healthy arm, within its artificial
            limits, and after any lock.
        grid_size: Points along each edge of a square grid, in rows from below; None for a random sample.
    """

    points: FloatArray
    view: View
    healthy_reach: BoolArray
    limited_reach: BoolArray
    lock_tolerant: BoolArray
    grid_size: int | None


def region_figure(
    maps: Sequence[RegionMap], bars: Sequence[tuple[str, float]], unit: str, error: FloatArray, caption: str
) -> Figure:
    """Plot maps of a region inside the reach of the healthy arm, and bars of the sizes.

    Args:
        maps: Map of each panel.
        bars: Names and sizes; the last one is the failure-tolerant region.
        unit: Axis label of the sizes, with the unit.
        error: (2,) distances from the size of the region to the lower and upper end of its interval.
        caption: Line below the figure.
    """
    with styled_figure(WIDTH_IN, 4.6) as figure:
        panels = figure.subplots(1, len(maps) + 1, width_ratios=[1.0] * len(maps) + [0.9 if len(maps) > 1 else 1.1])
        for axes, region_map in zip(panels, maps, strict=False):
            _draw_map(axes, region_map)
        axes = panels[-1]
        positions = np.arange(len(bars))
        colors = [EMPTY_COLOR, *[SKY] * (len(bars) - 2), BLUE]
        sizes = [size for _, size in bars]
        axes.barh(positions, sizes, height=0.64, color=colors)
        axes.errorbar(sizes[-1], positions[-1], xerr=error.reshape(2, 1), color=INK, capsize=3, linewidth=1)
        for position, size in zip(positions, sizes, strict=True):
            error_width = error[1] if position == positions[-1] else 0.0
            axes.annotate(
                f"{size:.3g}", (size + error_width, position), (4, 0), textcoords="offset points", va="center", fontsize=9
            )
        axes.set_yticks(positions, [format_label(name, 30) for name, _ in bars])
        axes.set(xlabel=unit, xlim=(0, max(sizes) * 1.2 or 1.0), ylim=(len(bars) - 0.45, -0.55), title="Size")
        axes.grid(axis="y", visible=False)
        axes.tick_params(axis="y", length=0)
        legend_entries = (
            (EMPTY_COLOR, "healthy, own limits"),
            (SKY, "healthy, artificial limits"),
            (BLUE, "after any single lock"),
        )
        handles = [Patch(facecolor=color, label=legend_text) for color, legend_text in legend_entries]
        figure.legend(handles=handles, loc="outside upper left", ncols=3)
        figure.supxlabel(format_label(caption, 220), fontsize=9, color=SOFT)
    return figure


def _draw_map(axes: Axes, region: RegionMap) -> None:
    colored_sets = ((region.healthy_reach, EMPTY_COLOR), (region.limited_reach, SKY), (region.lock_tolerant, BLUE))
    if region.grid_size is not None:
        grid_shape = (region.grid_size, region.grid_size)
        x, y = (region.points[:, axis].reshape(grid_shape) for axis in (0, 1))
        for chosen, color in colored_sets:
            if chosen.any():
                axes.contourf(x, y, chosen.reshape(grid_shape).astype(float), levels=[0.5, 1.5], colors=[color])
    else:
        for chosen, color in colored_sets:
            axes.scatter(region.points[chosen, 0], region.points[chosen, 1], s=9, c=color, linewidths=0)
    axes.plot(0, 0, marker="s", color=INK, markersize=6)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel=region.view.names[0], ylabel=region.view.names[1], title=region.view.title)
