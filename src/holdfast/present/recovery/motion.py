"""Pictures of a recovery: the arm on its way, and what is left of the workspace; its page and its folder."""

from __future__ import annotations

import json
from functools import partial
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.files.output import put
from holdfast.present import results
from holdfast.present.recovery.console import on_the_way
from holdfast.report.figures import BLUE, FAINT, ORANGE, SKY, SOFT, WIDTH, finished, legend_below, plain, save_png, style
from holdfast.report.scenes import Scale, Scene, color_bar, dot_size, draw_view, view_spans
from holdfast.report.timelines import COLORS
from holdfast.report.views import SIDE, sides

if TYPE_CHECKING:
    from holdfast.present.results import Drawings
    from holdfast.recovery.recovery import Recovery

Array = NDArray[np.float64]

_DOTS = 160  # of the tool's path
_BETWEEN = 4  # ghosts of the arm on its way


def drawings(recovery: Recovery) -> Drawings:
    """The arm on its way, from the side and from above, its timing, and maps of what is left, where these were asked for."""
    left: Drawings = {} if recovery.left is None else recovery.left._presented("drawings")
    timing: Drawings = {} if recovery.timed is None else {"timing": partial(_timing, recovery)}
    return {"motion": partial(_motion, recovery), **timing, **left}


def save(recovery: Recovery, folder: Path, command: str = "") -> list[Path]:
    """recovery.json, motion.png, waypoints.csv if there is a motion, timing.png and left.png if asked for, and report.html."""
    (file,) = put(folder, {"recovery.json": json.dumps(recovery.to_dict(), indent=2) + "\n"})
    drawn = recovery.figures()
    motion, *left = [save_png(figure, folder / f"{name}.png", 150) for name, figure in drawn.items()]
    waypoints = [recovery.to_csv(folder / "waypoints.csv")] if len(recovery.q) else []
    return [file, motion, *waypoints, *left, results.write(recovery, folder / "report.html", command, drawn)]


def _motion(recovery: Recovery) -> Figure:
    """The arm where it is, on its way and where it ends, with the path of the tool coloured from its start to its end."""
    arm = recovery.arm
    moving = len(recovery.q) > 1
    way = on_the_way(recovery.q, _DOTS) if moving else np.zeros((0, arm.n))
    points = arm.forward_kinematics(way)[:, :3, 3] if moving else np.zeros((0, 3))
    between = on_the_way(recovery.q, _BETWEEN + 2)[1:-1] if moving else np.zeros((0, arm.n))
    start, *ghosts, final = arm.frames(np.vstack([recovery.at, between, recovery.q[-1] if moving else recovery.at]))[..., :3, 3]
    # What only widens the view: the places of everything that is drawn by hand below.
    reach = np.concatenate([start, *ghosts, *([] if recovery.goal_pose is None else [recovery.goal_pose[None, :3, 3]])])
    box = np.array([reach.min(axis=0), reach.max(axis=0)])
    scene = Scene(
        points,
        np.linspace(0, 100, len(points)),
        np.zeros((0, 3)),
        chain=final,
        nodes=final[1:-1],
        square=arm.prismatic,
        box=box,
    )
    views = sides(scene.extent) or [SIDE]
    scene = Scene(scene.points, scene.values, scene.missing, chain=scene.chain, nodes=scene.nodes, square=scene.square)
    wide = Scene(reach, np.zeros(len(reach)), points, chain=final)
    scale = Scale(0.0, 100.0)
    with style():
        panel = 4.1 if len(views) > 1 else 5.0
        spans, height = view_spans(wide, views, panel, 2.4, 4.8)
        figure = Figure(figsize=(WIDTH if len(views) > 1 else panel + 2.6, height + 1.7))
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        middle = wide.extent.mean(axis=0)
        for axes, view in zip(panels, views, strict=True):
            for k, ghost in enumerate(ghosts):
                axes.plot(*view.of(ghost).T, color=FAINT, linewidth=1.6, zorder=1.6, label="on the way" if k == 0 else None)
            if moving:
                axes.plot(
                    *view.of(start).T, color=BLUE, linewidth=2.0, marker="o", markersize=3, zorder=2.6, label="where it is"
                )
            draw_view(axes, scene, view, scale, dot_size(scene, views, panel / spans[0]), spans, panel)
            locked = np.array([start[1 + arm.joint_index(name)] for name in recovery.locked])
            last = np.array([final[1 + arm.joint_index(name)] for name in recovery.locked])
            axes.plot(*view.of(locked).T, "X", color=ORANGE, markersize=8, zorder=3.6, label="locked joint")
            axes.plot(*view.of(last).T, "X", color=ORANGE, markersize=8, zorder=3.6)
            axes.plot([], [], color="#1b1f24", linewidth=2.8, label="where it ends" if moving else "where it is and stays")
            if recovery.goal_pose is not None:
                place = view.of(recovery.goal_pose[:3, 3])
                axes.plot(*place, "*", color=SKY, markeredgecolor=SOFT, markersize=13, zorder=3.4, label="goal of the tool")
            x, y = view.of(middle)
            axes.set(xlim=(x - spans[0] / 2, x + spans[0] / 2), ylim=(y - spans[1] / 2, y + spans[1] / 2))
        if moving:
            color_bar(figure, scene, scale, list(panels), "fraction of the tool's path, %")
        legend_below(figure, panels[0], 5)
        figure.suptitle(plain(_title(recovery), 110), fontsize=10, x=0.01, ha="left")
        return finished(figure)


def _timing(recovery: Recovery) -> Figure:
    """Rates and accelerations of the joints that move, in parts of their limits, over time."""
    timed = recovery.timed
    assert timed is not None
    moving = np.flatnonzero(np.abs(timed.qd).max(axis=0) > 0)
    speed = np.where(np.isfinite(recovery.degraded.v), recovery.degraded.v, np.abs(timed.qd).max(axis=0))
    with style():
        figure = Figure(figsize=(WIDTH, 4.6))
        panels = figure.subplots(2, 1, sharex=True)
        for axes, values, most, label in (
            (panels[0], timed.qd, speed, "rate / limit"),
            (panels[1], timed.qdd, timed.accelerations, "acceleration / limit"),
        ):
            for place in (-1, 0, 1):
                axes.axhline(place, color=FAINT, linewidth=1.0, zorder=1)
            for color, k in zip(cycle(COLORS), moving, strict=False):
                axes.plot(timed.time, values[:, k] / most[k], color=color, linewidth=1.4, label=plain(timed.arm.joint_names[k]))
            axes.set(ylabel=label, ylim=(-1.1, 1.1))
        panels[1].set(xlabel="time, s")
        legend_below(figure, panels[0], 4)
        figure.suptitle(plain(f"{recovery.arm.name}: {timed.describe()}", 110), fontsize=10, x=0.01, ha="left")
        return finished(figure)


def _title(recovery: Recovery) -> str:
    if len(recovery.q) < 2:
        return f"{recovery.arm.name}: {recovery.ending.phrase}, no motion"
    return f"{recovery.arm.name}: {recovery.ending.phrase}, {len(recovery.q)} waypoints, {recovery.length:.3g} {recovery.unit}"
