"""Figures of the lock survival of a motion: lines over time, and maps with a strip of values at every time."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.report.palette import EMPTY_COLOR, INK
from holdfast.kinematics.solvers import joint_space
from holdfast.response.lock_survival.dynamic_program import SearchBounds
from holdfast.response.lock_survival.planning import LockSurvival

_MAP_BINS = 64
_SAMPLES_PER_NODE = 8  # samples between two nodes


def draw_survival(survival: LockSurvival) -> report.Figure:
    """Draw the survival over time with that of other motions."""
    bound = survival.survival_bound
    level = None if bound is None else (100 * bound, "no motion survives more on average")
    motion_name = "most locks survived" if survival.found is not None else "this motion"
    lines = {motion_name: 100 * survival.curve()} | {each.name: 100 * each.curve for each in survival.comparisons}
    panel = report.motions.TimePanel(survival.time, lines, "survival if a joint locks now, %", "", reference_level=level)
    return report.motions.motion_figure([panel], "", "time, s", panel_width=report.WIDTH_IN)


def draw_jump(survival: LockSurvival) -> report.Figure:
    """Draw the velocity that the tool loses when a joint stops at once."""
    lines = dict(zip(survival.arm.joint_names, survival.jump.linear.T, strict=True))
    panel = report.motions.TimePanel(survival.time, lines, "tool velocity lost, m/s", "")
    return report.motions.motion_figure([panel], "", "time, s", panel_width=report.WIDTH_IN)


def draw_map(survival: LockSurvival) -> report.Figure:
    """Draw which locks are survivable at every node, over the joint that the self-motion moves most."""
    search = survival.found
    assert search is not None
    joint = int(search.moved.argmax())
    factor, unit = survival.arm.joints[joint].display_unit
    is_turning = joint_space.is_unlimited(survival.arm)[joint]

    def display_position(q: FloatArray) -> FloatArray:
        return np.asarray(factor * (np.arctan2(np.sin(q), np.cos(q)) if is_turning else q))

    positions = display_position(np.concatenate(search.nodes)[:, joint])
    lower, upper = positions.min(), positions.max()
    edges = np.linspace(lower, upper + 1e-9 * (upper - lower + 1), _MAP_BINS + 1)
    lock_fractions = survival.rates.each / survival.rates.total
    values = np.full((survival.arm.n + 1, len(survival.time), _MAP_BINS), np.nan)
    for pose_index in range(len(survival.time)):
        curve_values, survives = _sample_curves(search, pose_index, joint)
        bins = np.clip(np.searchsorted(edges, display_position(curve_values), side="right") - 1, 0, _MAP_BINS - 1)
        order = np.argsort(survives @ lock_fractions, kind="stable")  # later writes replace earlier ones, so the best stays
        values[0, pose_index, bins[order]] = 100 * (survives @ lock_fractions)[order]
        values[1:, pose_index, bins[order]] = 100.0 * survives[order].T
    path = display_position(survival.q[:, joint])
    path[1:][np.abs(np.diff(path)) > (upper - lower) / 2] = np.nan  # the angle wraps around at pi
    titles, scale = ["all locks", *(f"lock of {name}" for name in survival.arm.joint_names)], report.Scale(0.0, 100.0)
    column_count = min(4, len(titles))
    row_count = -(-len(titles) // column_count)
    with report.styled_figure(report.WIDTH_IN, 2.2 * row_count + 1.1) as figure:
        axes = figure.subplots(row_count, column_count, squeeze=False, sharex=True, sharey=True)
        for panel_axes in axes.ravel()[len(titles) :]:
            panel_axes.set_visible(False)
        for index, (panel_axes, title) in enumerate(zip(axes.ravel(), titles, strict=False)):
            _draw_strip(panel_axes, survival.time, edges, values[index], path, scale)
            panel_axes.set_title(report.format_label(title), fontsize=9)
            if index % column_count == 0:
                panel_axes.set_ylabel(f"{survival.arm.joint_names[joint]}, {unit}")
            if index >= len(titles) - column_count:
                panel_axes.set_xlabel("time, s")
                panel_axes.tick_params(labelbottom=True)
        bar = figure.colorbar(scale.mappable, ax=list(axes.ravel()), shrink=0.8, aspect=14 * row_count, pad=0.015)
        report.label_color_bar(bar, "survivable, %", scale)
    return figure


def _sample_curves(search: SearchBounds, pose_index: int, joint: int) -> tuple[FloatArray, FloatArray]:
    """Return values (N,) of a joint along the curves of a pose, denser than its nodes, with the verdicts (N, n) of the nearer
    node.
    """
    values, is_connected = search.nodes[pose_index][:, joint], np.diff(search.curve[pose_index]) == 0
    first = np.flatnonzero(is_connected)
    fraction = np.linspace(0, 1, _SAMPLES_PER_NODE, endpoint=False)[:, None]
    interpolated = values[first] + fraction * (values[first + 1] - values[first])
    nearer = np.where(fraction < 0.5, first, first + 1)
    order = np.concatenate([np.arange(len(values)), nearer.ravel()])
    return np.concatenate([values, interpolated.ravel()]), search.survives[pose_index][order]


def _draw_strip(
    axes: report.Axes, time: FloatArray, edges: FloatArray, values: FloatArray, path: FloatArray, scale: report.Scale
) -> None:
    """Draw values (T, B) over time (T,) and the bins of a joint's position, and the position (T,) on the motion."""
    time_edges = np.concatenate([[time[0]], time[:-1] + np.diff(time) / 2, [time[-1]]])
    axes.set_facecolor(EMPTY_COLOR)
    colors = scale.mappable.to_rgba(values.T) * np.isfinite(values.T)[..., None]
    axes.pcolormesh(time_edges, edges, colors, rasterized=True)
    axes.plot(time, path, color="white", linewidth=2.6)
    axes.plot(time, path, color=INK, linewidth=1.3)
    axes.grid(visible=False)
    axes.set_xlim(time[0], time[-1])
