"""Figures, page, and folder of a recovery: the moving arm, and the remaining workspace."""

from __future__ import annotations

import json
from functools import partial
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from holdfast.core.files.output import write_files
from holdfast.interface.presentation import call_presenter, results
from holdfast.interface.presentation.recovery.console import resample_path
from holdfast.interface.report.figures import (
    BLUE,
    FAINT,
    ORANGE,
    SKY,
    SOFT,
    WIDTH_IN,
    format_label,
    legend_below,
    save_png,
    settle_layout,
    style,
)
from holdfast.interface.report.scenes import Scale, Scene, add_color_bar, choose_dot_area, draw_view, fit_view_spans
from holdfast.interface.report.timelines import LINE_COLORS
from holdfast.interface.report.views import SIDE_VIEW, choose_side_and_top_views

if TYPE_CHECKING:
    from holdfast.interface.presentation.results import Drawings
    from holdfast.response.recovery.recovery import Recovery


_PATH_DOTS = 160  # of the tool's path
_GHOST_COUNT = 4  # ghosts of the arm on its way


def drawings(recovery: Recovery) -> Drawings:
    """Draw the moving arm from the side and from above, its timing, and maps of the remaining workspace, as far as
    requested.
    """
    remainder: Drawings = {} if recovery.left is None else call_presenter(recovery.left, "drawings")
    timing: Drawings = {} if recovery.timed is None else {"timing": partial(_draw_timing, recovery)}
    return {"motion": partial(_draw_motion, recovery), **timing, **remainder}


def save(recovery: Recovery, folder: Path, command: str = "") -> list[Path]:
    """Write recovery.json, motion.png, waypoints.csv if there is a motion, timing.png and left.png if requested, and
    report.html.
    """
    (file,) = write_files(folder, {"recovery.json": json.dumps(recovery.to_dict(), indent=2) + "\n"})
    figures_by_name = recovery.figures()
    motion_file, *figure_files = [save_png(figure, folder / f"{name}.png", 150) for name, figure in figures_by_name.items()]
    waypoints = [recovery.to_csv(folder / "waypoints.csv")] if len(recovery.q) else []
    return [
        file,
        motion_file,
        *waypoints,
        *figure_files,
        results.write(recovery, folder / "report.html", command, figures_by_name),
    ]


def _draw_motion(recovery: Recovery) -> Figure:
    """Draw the arm at its start, on its path, and at its end; the path of the tool is coloured from start to end."""
    arm = recovery.arm
    has_motion = len(recovery.q) > 1
    path = resample_path(recovery.q, _PATH_DOTS) if has_motion else np.zeros((0, arm.n))
    points = arm.forward_kinematics(path)[:, :3, 3] if has_motion else np.zeros((0, 3))
    ghost_configurations = resample_path(recovery.q, _GHOST_COUNT + 2)[1:-1] if has_motion else np.zeros((0, arm.n))
    start, *ghosts, final = arm.frames(
        np.vstack([recovery.at, ghost_configurations, recovery.q[-1] if has_motion else recovery.at])
    )[..., :3, 3]
    # What only widens the view: the places of everything that is drawn by hand below.
    drawn_points = np.concatenate([start, *ghosts, *([] if recovery.goal_pose is None else [recovery.goal_pose[None, :3, 3]])])
    bounds = np.array([drawn_points.min(axis=0), drawn_points.max(axis=0)])
    scene = Scene(
        points,
        np.linspace(0, 100, len(points)),
        np.zeros((0, 3)),
        chain=final,
        nodes=final[1:-1],
        square=arm.prismatic,
        box=bounds,
    )
    views = choose_side_and_top_views(scene.extent) or [SIDE_VIEW]
    scene = Scene(scene.points, scene.values, scene.missing, chain=scene.chain, nodes=scene.nodes, square=scene.square)
    extent_scene = Scene(drawn_points, np.zeros(len(drawn_points)), points, chain=final)
    scale = Scale(0.0, 100.0)
    with style():
        panel_width = 4.1 if len(views) > 1 else 5.0
        spans, height = fit_view_spans(extent_scene, views, panel_width, 2.4, 4.8)
        figure = Figure(figsize=(WIDTH_IN if len(views) > 1 else panel_width + 2.6, height + 1.7))
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        center = extent_scene.extent.mean(axis=0)
        for axes, view in zip(panels, views, strict=True):
            for index, ghost in enumerate(ghosts):
                axes.plot(
                    *view.project(ghost).T, color=FAINT, linewidth=1.6, zorder=1.6, label="on the way" if index == 0 else None
                )
            if has_motion:
                axes.plot(
                    *view.project(start).T, color=BLUE, linewidth=2.0, marker="o", markersize=3, zorder=2.6, label="where it is"
                )
            draw_view(axes, scene, view, scale, choose_dot_area(scene, views, panel_width / spans[0]), spans, panel_width)
            locked_at_start = np.array([start[1 + arm.joint_index(name)] for name in recovery.locked])
            locked_at_end = np.array([final[1 + arm.joint_index(name)] for name in recovery.locked])
            axes.plot(*view.project(locked_at_start).T, "X", color=ORANGE, markersize=8, zorder=3.6, label="locked joint")
            axes.plot(*view.project(locked_at_end).T, "X", color=ORANGE, markersize=8, zorder=3.6)
            axes.plot([], [], color="#1b1f24", linewidth=2.8, label="where it ends" if has_motion else "where it is and stays")
            if recovery.goal_pose is not None:
                goal_point = view.project(recovery.goal_pose[:3, 3])
                axes.plot(
                    *goal_point, "*", color=SKY, markeredgecolor=SOFT, markersize=13, zorder=3.4, label="goal of the tool"
                )
            center_x, center_y = view.project(center)
            axes.set(
                xlim=(center_x - spans[0] / 2, center_x + spans[0] / 2), ylim=(center_y - spans[1] / 2, center_y + spans[1] / 2)
            )
        if has_motion:
            add_color_bar(figure, scene, scale, list(panels), "fraction of the tool's path, %")
        legend_below(figure, panels[0], 5)
        figure.suptitle(format_label(_compose_title(recovery), 110), fontsize=10, x=0.01, ha="left")
        return settle_layout(figure)


def _draw_timing(recovery: Recovery) -> Figure:
    """Draw rates and accelerations of the moving joints as fractions of their limits, over time."""
    timed_motion = recovery.timed
    assert timed_motion is not None
    moving_joints = np.flatnonzero(np.abs(timed_motion.qd).max(axis=0) > 0)
    speed_limits = np.where(np.isfinite(recovery.degraded.v), recovery.degraded.v, np.abs(timed_motion.qd).max(axis=0))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 4.6))
        panels = figure.subplots(2, 1, sharex=True)
        for axes, values, limits, label in (
            (panels[0], timed_motion.qd, speed_limits, "rate / limit"),
            (panels[1], timed_motion.qdd, timed_motion.accelerations, "acceleration / limit"),
        ):
            for level in (-1, 0, 1):
                axes.axhline(level, color=FAINT, linewidth=1.0, zorder=1)
            for color, joint in zip(cycle(LINE_COLORS), moving_joints, strict=False):
                axes.plot(
                    timed_motion.time,
                    values[:, joint] / limits[joint],
                    color=color,
                    linewidth=1.4,
                    label=format_label(timed_motion.arm.joint_names[joint]),
                )
            axes.set(ylabel=label, ylim=(-1.1, 1.1))
        panels[1].set(xlabel="time, s")
        legend_below(figure, panels[0], 4)
        figure.suptitle(format_label(f"{recovery.arm.name}: {timed_motion.describe()}", 110), fontsize=10, x=0.01, ha="left")
        return settle_layout(figure)


def _compose_title(recovery: Recovery) -> str:
    if len(recovery.q) < 2:
        return f"{recovery.arm.name}: {recovery.ending.phrase}, no motion"
    return f"{recovery.arm.name}: {recovery.ending.phrase}, {len(recovery.q)} waypoints, {recovery.length:.3g} {recovery.unit}"
