"""Figures of the study."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

import holdfast as hf
from holdfast.interface.report import (
    INK,
    KIND_STYLES,
    WIDTH_IN,
    Stack,
    bin_positions,
    place_maps,
    save_png,
    settle_layout,
    stack_figure,
    style,
)
from measurements.stuck_panda.study import ELBOW, SHOWN, Elbow, arm

Array = NDArray[np.float64]

OUTCOMES = ("converged", "stuck", "moving", "undecided")
CELLS = 6  # of a map, along its longer edge


ORDER = ("degenerate", "source", "saddle", "solution", "sink")  # of drawing


def draw_joints(task: str, choice: hf.LawChoice, path: Path) -> None:
    """How motions ended, by locked joint and law."""
    stacks = []
    maps = [choice.map_of(name) for name in SHOWN]
    for k, joint in enumerate(maps[0].columns):
        shares = np.array([[m.shares(o)[joint].value for o in OUTCOMES] for m in maps])
        arrived = [m.shares()[joint] for m in maps]
        level = maps[0].shares("in_reach")[joint].value
        title = f"{joint} locked" if k < arm().n else "no joint locked"
        stacks.append(
            Stack(
                name=title,
                bars=SHOWN,
                shares=shares,
                low=np.array([i.low for i in arrived]),
                high=np.array([i.high for i in arrived]),
                level=level,
            )
        )
    label = (
        f"share of {int(maps[0].has_configuration.sum())} motions to the target, each law and locked joint; "
        f"{arm().name}, task {task}"
    )
    save_png(stack_figure(stacks, OUTCOMES, label, level="target within reach"), path, dpi=80)


def draw_laws(choices: Mapping[str, hf.LawChoice], path: Path) -> None:
    """How motions ended under every law, each joint as likely to lock as any other."""
    stacks = []
    for task, choice in choices.items():
        shares = np.array([[_over_joints(choice.map_of(name), o) for o in OUTCOMES] for name in choice.names])
        arrived = [choice.share(name) for name in choice.names]
        low, high = np.array([i.low for i in arrived]), np.array([i.high for i in arrived])
        stacks.append(
            Stack(
                name=f"task {task}",
                bars=choice.names,
                shares=shares,
                low=low,
                high=high,
                level=_over_joints(choice.maps[0], "in_reach"),
            )
        )
    label = f"share of the failures, each joint as likely to lock as any other; {arm().name}"
    save_png(stack_figure(stacks, OUTCOMES, label, level="target within reach"), path, dpi=80)


def _over_joints(m: hf.ConvergenceMap, outcome: str) -> float:
    return float(np.nanmean(m.values(outcome)[:, :-1]))


def draw_map(task: str, choice: hf.LawChoice, goal: Array, path: Path) -> None:
    """From where motions end how when the elbow locks: places seen from the side, by law."""
    maps = [choice.map_of(name) for name in SHOWN]
    points = maps[0].places.points[:, [0, 2]]
    rows: dict[str, Array] = {}
    for outcome in OUTCOMES:
        values = 100 * np.stack([m.values(outcome)[:, ELBOW] for m in maps], axis=1)
        plane, rows[outcome] = bin_positions(points, values, CELLS)
    plane = replace(plane, labels=("x, m", "z, m"), mark=(float(goal[0, 3]), float(goal[2, 3])), mark_label="target")
    caption = (
        f"{arm().name}, task {task}, joint 4 locked from the start: {int(maps[0].has_configuration.sum())} motions from "
        f"{len(points)} "
        "places "
        "of the end effector\nseen from the side, mean over the places in a cell, whatever their depth"
    )
    save_png(place_maps(plane, rows, SHOWN, label="of the motions, percent", caption=caption), path, dpi=80)


def draw_elbow(found: Sequence[Elbow], path: Path) -> None:
    """Errors at rest over the locked angle, with where stuck runs ended: a panel for each task and law."""
    panels = list(dict.fromkeys((e.task, e.law) for e in found))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.3 * -(-len(panels) // 2) + 0.9))
        every = np.ravel(figure.subplots(-(-len(panels) // 2), 2, squeeze=False, sharex=True))
        for axes, (task, law) in zip(every, panels, strict=False):
            for e in (e for e in found if (e.task, e.law) == (task, law)):
                p = e.points
                for kind, (color, _, _, marker) in KIND_STYLES.items():
                    for loose in (False, True):
                        rows = (np.array(p.kinds, dtype=object) == kind) & (p.continuum == loose)
                        levels = np.unique(np.round(p.error[rows], 3))
                        face = "none" if loose else color
                        axes.plot(
                            np.full(len(levels), e.angle),
                            levels,
                            marker,
                            color=color,
                            markerfacecolor=face,
                            markersize=6,
                            zorder=3 + ORDER.index(kind),
                        )
                axes.plot(np.full(len(e.errors), e.angle + 5), e.errors, "_", color=INK, markersize=9, alpha=0.5)
            size = "m" if task == "position" else "m and rad"
            axes.set(title=f"task {task}, {law}", ylabel=f"error of the end effector, {size}", xlim=(-180, 0))
            axes.set_xticks(range(-180, 1, 30))
        for axes in every[-2:]:
            axes.set_xlabel("joint 4 locked at, deg")
        handles = [Line2D([], [], marker=m, color=c, linestyle="none", label=k) for k, (c, _, _, m) in KIND_STYLES.items()]
        handles.append(
            Line2D([], [], marker="o", color=INK, markerfacecolor="none", linestyle="none", label="hollow: a continuum")
        )
        handles.append(Line2D([], [], marker="_", color=INK, linestyle="none", label="stuck runs ended"))
        figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), columnspacing=1.2, handletextpad=0.3)
        save_png(settle_layout(figure), path, dpi=100)
