"""Figures and views of a recovery: the moving arm, and its timing."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from holdfast.interface import report
from holdfast.interface.presentation.arm.view import scene
from holdfast.interface.report.page import Picture, Section
from holdfast.interface.report.palette import BLUE, FAINT, ORANGE, SKY, SOFT
from holdfast.interface.report.views import SIDE_VIEW, choose_side_and_top_views
from holdfast.response.recovery.recovery import Recovery

_PATH_DOTS = 160  # samples of the tool path
_GHOST_COUNT = 4  # drawings of the arm between start and end
_VIEW_FRAMES = 121


def build_sections(recovery: Recovery) -> list[Section]:
    """Build the view of the motion with the locked joints, or of the arm if there is no motion."""
    goals = [] if recovery.goal_pose is None else [recovery.goal_pose]
    if len(recovery.q) < 2:
        caption = "The arm, which does not move, with the directions of motion that the lock removes."
        view = scene(
            recovery.arm, recovery.at, locked=list(recovery.locked), task=recovery.task, targets=goals, cell=recovery.cell
        )
        return [Section("The arm", [Picture(view.to_html("motion", caption), caption)])]
    q, time = _resample_path(recovery.q, _VIEW_FRAMES), np.linspace(0.0, 100.0, _VIEW_FRAMES)
    readings, speed_text = [f"{progress:.0f} % of the path" for progress in time], "at constant speed in joint space"
    if recovery.timed is not None:
        timed_motion, time = recovery.timed, np.linspace(0.0, recovery.timed.time[-1], _VIEW_FRAMES)
        q = np.stack([np.interp(time, timed_motion.time, column) for column in timed_motion.q.T], axis=1)
        readings, speed_text = [f"{instant:.2f} s" for instant in time], "with its timing within the acceleration limits"
    view = scene(recovery.arm, q, locked=list(recovery.locked), targets=goals, time=time, readings=readings, cell=recovery.cell)
    caption = f"The motion with the locked joints, {speed_text}." + " The target of the end effector is marked." * bool(goals)
    return [Section("The motion", [Picture(view.to_html("motion", caption), caption)])]


def draw_motion(recovery: Recovery) -> report.Figure:
    """Draw the arm at its start, on its path, and at its end; the path of the tool is coloured from start to end."""
    arm = recovery.arm
    has_motion = len(recovery.q) > 1
    path = _resample_path(recovery.q, _PATH_DOTS) if has_motion else np.zeros((0, arm.n))
    points = arm.forward_kinematics(path)[:, :3, 3] if has_motion else np.zeros((0, 3))
    ghost_configurations = _resample_path(recovery.q, _GHOST_COUNT + 2)[1:-1] if has_motion else np.zeros((0, arm.n))
    start, *ghosts, final = arm.frames(
        np.vstack([recovery.at, ghost_configurations, recovery.q[-1] if has_motion else recovery.at])
    )[..., :3, 3]
    # The box widens the view so that it contains everything that is drawn by hand below.
    drawn_points = np.concatenate([start, *ghosts, *([] if recovery.goal_pose is None else [recovery.goal_pose[None, :3, 3]])])
    bounds = np.array([drawn_points.min(axis=0), drawn_points.max(axis=0)])
    arm_scene = report.Scene(
        points,
        np.linspace(0, 100, len(points)),
        np.zeros((0, 3)),
        chain=final,
        nodes=final[1:-1],
        square=arm.prismatic,
        box=bounds,
    )
    views = choose_side_and_top_views(arm_scene.extent) or [SIDE_VIEW]
    arm_scene = replace(arm_scene, box=None)
    extent_scene = report.Scene(drawn_points, np.zeros(len(drawn_points)), points, chain=final)
    scale = report.Scale(0.0, 100.0)
    panel_width = 4.1 if len(views) > 1 else 5.0
    spans, height = report.scenes.fit_view_spans(extent_scene, views, panel_width, 2.4, 4.8)
    with report.styled_figure(report.WIDTH_IN if len(views) > 1 else panel_width + 2.6, height + 1.7) as figure:
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        center = extent_scene.extent.mean(axis=0)
        for axes, view in zip(panels, views, strict=True):
            for index, ghost in enumerate(ghosts):
                axes.plot(
                    *view.project(ghost).T, color=FAINT, linewidth=1.6, zorder=1.6, label="on the way" if index == 0 else None
                )
            if has_motion:
                axes.plot(
                    *view.project(start).T, color=BLUE, linewidth=2.0, marker="o", markersize=3, zorder=2.6, label="start"
                )
            report.scenes.draw_view(
                axes,
                arm_scene,
                view,
                scale,
                report.scenes.choose_dot_area(arm_scene, views, panel_width / spans[0]),
                spans,
                panel_width,
            )
            locked_at_start = np.array([start[1 + arm.joint_index(name)] for name in recovery.locked])
            locked_at_end = np.array([final[1 + arm.joint_index(name)] for name in recovery.locked])
            axes.plot(*view.project(locked_at_start).T, "X", color=ORANGE, markersize=8, zorder=3.6, label="locked joint")
            axes.plot(*view.project(locked_at_end).T, "X", color=ORANGE, markersize=8, zorder=3.6)
            axes.plot([], [], color="#1b1f24", linewidth=2.8, label="end" if has_motion else "the arm, without a motion")
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
            report.scenes.add_color_bar(figure, arm_scene, scale, list(panels), "fraction of the tool's path, %")
        report.legend_below(figure, panels[0], 5)
        figure.suptitle(report.format_label(_compose_title(recovery), 110), fontsize=10, x=0.01, ha="left")
    return figure


def draw_timing(recovery: Recovery) -> report.Figure:
    """Draw rates and accelerations of the moving joints as fractions of their limits, over time."""
    timed_motion = recovery.timed
    assert timed_motion is not None
    moving_joints = np.flatnonzero(np.abs(timed_motion.qd).max(axis=0) > 0)
    speed_limits = np.where(np.isfinite(recovery.degraded.v), recovery.degraded.v, np.abs(timed_motion.qd).max(axis=0))
    panels = [
        report.motions.TimePanel(
            timed_motion.time,
            {timed_motion.arm.joint_names[joint]: values[:, joint] / limits[joint] for joint in moving_joints},
            f"{quantity} / limit",
            title,
            reference_level=(1.0, "limit"),
        )
        for quantity, title, values, limits in (
            ("rate", "Rates", timed_motion.qd, speed_limits),
            ("acceleration", "Accelerations", timed_motion.qdd, timed_motion.accelerations),
        )
    ]
    return report.motions.motion_figure(panels, f"{recovery.arm.name}: {timed_motion.describe()}", "time, s")


def _compose_title(recovery: Recovery) -> str:
    if len(recovery.q) < 2:
        return f"{recovery.arm.name}: {recovery.ending.phrase}, no motion"
    return f"{recovery.arm.name}: {recovery.ending.phrase}, {len(recovery.q)} waypoints, {recovery.length:.3g} {recovery.unit}"


def _resample_path(waypoints: Any, count: int) -> Any:
    """Resample the path (K, n) at ``count`` equal fractions of its length: configurations (count, n)."""
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(waypoints, axis=0), axis=1))])
    samples = np.linspace(0, lengths[-1], count)
    return np.stack([np.interp(samples, lengths, column) for column in waypoints.T], axis=1)
