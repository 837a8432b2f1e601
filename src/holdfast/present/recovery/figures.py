"""Pictures of a recovery: the arm on its way, and what is left of the workspace."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.present.assessment.sections.survival import before_and_after_figure
from holdfast.report.figures import BLUE, FAINT, ORANGE, SKY, SOFT, WIDTH, finished, legend_below, plain, style
from holdfast.report.scenes import Scale, Scene, View, color_bar, dot_size, draw_view, view_spans

if TYPE_CHECKING:
    from holdfast.recovery.recovery import Recovery

Array = NDArray[np.float64]

_DOTS = 160  # of the hand's way
_BETWEEN = 4  # ghosts of the arm on its way


def _on_the_way(q: Array, count: int) -> Array:
    """Configurations (count, n) at equal shares of the way (K, n)."""
    steps = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1))])
    at = np.linspace(0, steps[-1], count)
    return np.stack([np.interp(at, steps, column) for column in q.T], axis=1)


def _views(extent: Array) -> list[View]:
    size = np.diff(extent, axis=0)[0]
    flat = size < 1e-6 * max(float(size.max()), 1e-6)
    side = View(1, 2, "Side view") if size[1] > 1.5 * size[0] else View(0, 2, "Side view")
    found = [v for v in (side, View(0, 1, "Top view")) if not (flat[v.right] or flat[v.up])]
    return found or [View(0, 2 if flat[1] else 1, "View")]


def scene_figure(recovery: Recovery) -> Figure:
    """The arm where it stands, on its way and where it ends, with the way of the hand coloured by its share."""
    arm = recovery.arm
    moving = len(recovery.q) > 1
    way = _on_the_way(recovery.q, _DOTS) if moving else np.zeros((0, arm.n))
    points = arm.forward_kinematics(way)[:, :3, 3] if moving else np.zeros((0, 3))
    between = _on_the_way(recovery.q, _BETWEEN + 2)[1:-1] if moving else np.zeros((0, arm.n))
    start, *ghosts, final = arm.frames(np.vstack([recovery.at, between, recovery.q[-1] if moving else recovery.at]))[..., :3, 3]
    # What only widens the view: the places of everything that is drawn by hand below.
    reach = np.concatenate([start, *ghosts, *([] if recovery.goal_pose is None else [recovery.goal_pose[None, :3, 3]])])
    box = np.array([reach.min(axis=0), reach.max(axis=0)])
    scene = Scene(points, np.linspace(0, 100, len(points)), np.zeros((0, 3)), final, final[1:-1], arm.prismatic, box)
    views = _views(scene.extent)
    scene = Scene(scene.points, scene.values, scene.missing, scene.chain, scene.nodes, scene.square)
    wide = Scene(reach, np.zeros(len(reach)), points, final)
    scale = Scale(0.0, 100.0)
    with style():
        panel = 4.1 if len(views) > 1 else 5.0
        spans, height = view_spans(wide, views, panel, 2.4, 4.8)
        figure = Figure(figsize=(WIDTH if len(views) > 1 else panel + 2.6, height + 1.7))
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        middle = wide.extent.mean(axis=0)
        for axes, view in zip(panels, views, strict=True):
            pick = [view.right, view.up]
            for k, ghost in enumerate(ghosts):
                axes.plot(*ghost[:, pick].T, color=FAINT, linewidth=1.6, zorder=1.6, label="on the way" if k == 0 else None)
            if moving:
                axes.plot(
                    *start[:, pick].T, color=BLUE, linewidth=2.0, marker="o", markersize=3, zorder=2.6, label="where it stands"
                )
            draw_view(axes, scene, view, scale, dot_size(scene, views, panel / spans[0]), spans, panel)
            locked = np.array([start[1 + arm.joint_index(name)] for name in recovery.locked])
            last = np.array([final[1 + arm.joint_index(name)] for name in recovery.locked])
            axes.plot(*locked[:, pick].T, "X", color=ORANGE, markersize=8, zorder=3.6, label="locked joint")
            axes.plot(*last[:, pick].T, "X", color=ORANGE, markersize=8, zorder=3.6)
            axes.plot([], [], color="#1b1f24", linewidth=2.8, label="where it ends" if moving else "where it stands and stays")
            if recovery.goal_pose is not None:
                place = recovery.goal_pose[:3, 3][pick]
                axes.plot(*place, "*", color=SKY, markeredgecolor=SOFT, markersize=13, zorder=3.4, label="goal of the hand")
            axes.set_xlim(middle[view.right] - spans[0] / 2, middle[view.right] + spans[0] / 2)
            axes.set_ylim(middle[view.up] - spans[1] / 2, middle[view.up] + spans[1] / 2)
        if moving:
            color_bar(figure, scene, scale, list(panels), "share of the hand's way, %")
        legend_below(figure, panels[0], 5)
        figure.suptitle(plain(_title(recovery), 110), fontsize=10, x=0.01, ha="left")
        return finished(figure)


def _title(recovery: Recovery) -> str:
    if len(recovery.q) < 2:
        return f"{recovery.arm.name}: {recovery.ending.name}, no motion"
    return f"{recovery.arm.name}: {recovery.ending.name}, {len(recovery.q)} waypoints, {recovery.length:.3g} {recovery.unit}"


def left_figure(recovery: Recovery) -> Figure:
    """Maps of the share of targets reached by the healthy and by the failed arm."""
    left = recovery.left
    if left is None or not left.healthy.any():
        raise InputError("there is no map: what is left of the workspace was not asked for, or nothing was reached before")
    low, high = left.position.min(axis=0), left.position.max(axis=0)
    view = _views(np.array([low, high]))[0]
    return before_and_after_figure(left.position, left.healthy, left.locked, view, ", ".join(recovery.locked))
