"""Motions of the end effector in chosen trials, with the part of the workspace that a failure removes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Annulus, Circle

from holdfast.core.typing import FloatArray
from holdfast.interface.report.figures import WIDTH_IN, format_label, styled_figure
from holdfast.interface.report.palette import FAINT, INK, ORANGE, SOFT
from holdfast.model.arm.model import Arm

_TIME_COLORMAP = LinearSegmentedColormap.from_list("time", ["#b9d6ee", "#0a5c9e", "#04233f"])
_LOST_COLOR = "#e4e7ea"


@dataclass(frozen=True)
class Ring:
    """Ring that is the workspace of a planar arm: centre (x, y), inner radius, and outer radius, m."""

    centre: tuple[float, float]
    inner: float
    outer: float


def ring(arm: Arm, q: FloatArray, locked: int | None = None) -> Ring | None:
    """Return the ring that the tool point of a planar arm can reach, healthy or with one joint locked.

    Args:
        arm: Arm of the experiment.
        q: (n,) configuration, rad; the joint is locked at its position in ``q``.
        locked: Index of the locked joint from 0; None for the healthy arm.

    Returns:
        The ring, or None if the reachable set is not a ring, which requires that all axes are parallel to z and that all
        joints are revolute and unlimited.
    """
    jacobian = arm.jacobian(q)
    rotation_row = jacobian[5]
    is_planar = np.allclose(np.abs(rotation_row), 1.0, atol=1e-9) and np.allclose(jacobian[2:5], 0.0, atol=1e-9)
    if arm.prismatic.any() or not is_planar or not (arm.upper - arm.lower >= 2 * np.pi - 1e-9).all():
        return None
    joints = arm.frames(q)[1:, :2, 3]  # and the tool
    joint_positions = joints if locked is None else np.delete(joints, locked, axis=0)
    links = np.linalg.norm(np.diff(joint_positions, axis=0), axis=1)
    outer = float(links.sum())
    return Ring(
        (float(joint_positions[0, 0]), float(joint_positions[0, 1])), max(0.0, 2 * float(links.max(initial=0.0)) - outer), outer
    )


@dataclass(frozen=True, kw_only=True)
class Motion:
    """Motion of one trial.

    Attributes:
        path: (K, 2) tool positions, m.
        title: Title of the panel.
        target: (2,) position of the target, m.
        radius: Radius of the target circle, m.
        whole: Workspace of the healthy arm; None if it is not drawn.
        left: Workspace that remains after the failure; None if nothing is lost.
    """

    path: FloatArray
    title: str
    target: FloatArray
    radius: float
    whole: Ring | None = None
    left: Ring | None = None


def motions_figure(motions: Sequence[Motion]) -> Figure:
    """Draw motions of trials side by side, darker with time, with the lost part of the workspace in grey (Figs. 5 to 7)."""
    columns = min(4, len(motions))
    row_count = -(-len(motions) // columns)
    height = 0.45 + row_count * (WIDTH_IN / columns + 0.3)
    with styled_figure(WIDTH_IN, height) as figure:
        figure.set_layout_engine("none")
        layout = {
            "left": 0.055,
            "right": 0.995,
            "top": 1 - 0.4 / height,
            "bottom": 0.5 / height,
            "wspace": 0.06,
            "hspace": 0.22,
        }
        panels = figure.subplots(row_count, columns, squeeze=False, sharex=True, sharey=True, gridspec_kw=layout).ravel()
        for axes, motion in zip(panels, motions, strict=False):
            if motion.whole is not None:
                ring_color = "white" if motion.left is None else _LOST_COLOR
                axes.add_patch(_make_ring_patch(motion.whole, facecolor=ring_color, edgecolor=SOFT, linewidth=0.9, zorder=0.5))
            if motion.whole is not None and motion.left is not None:
                axes.add_patch(_make_ring_patch(motion.left, facecolor="white", edgecolor=FAINT, linewidth=0.8, zorder=0.6))
            start = motion.path[0]
            axes.plot(
                [start[0], motion.target[0]],
                [start[1], motion.target[1]],
                color=SOFT,
                linewidth=0.9,
                linestyle=(0, (4, 3)),
                zorder=1,
            )
            segments = np.stack([motion.path[:-1], motion.path[1:]], axis=1)
            path_lines = LineCollection(list(segments), cmap=_TIME_COLORMAP, linewidths=1.5, zorder=3, capstyle="round")
            path_lines.set_array(np.linspace(0, 1, max(len(segments), 1)))
            axes.add_collection(path_lines)
            axes.plot([start[0]], [start[1]], "o", color=INK, markersize=4, zorder=4)
            axes.add_patch(
                Circle(
                    (float(motion.target[0]), float(motion.target[1])),
                    motion.radius,
                    fill=False,
                    edgecolor=ORANGE,
                    linewidth=1.6,
                    zorder=4,
                )
            )
            axes.set_title(fill(format_label(motion.title, 48), 26, break_on_hyphens=False), fontsize=8.6, pad=4)
            axes.set_aspect("equal")
            axes.grid(visible=False)
            axes.tick_params(labelsize=8)
        for axes in panels[len(motions) :]:
            axes.set_visible(False)
        for axes in panels[::columns]:
            axes.set_ylabel("y, m")
        for axes in panels[max(0, len(motions) - columns) : len(motions)]:
            axes.set_xlabel("x, m")
        lower, upper = _find_bounding_box(motions)
        center, half_width = (lower + upper) / 2, 0.53 * float((upper - lower).max())
        panels[0].set(
            xlim=(center[0] - half_width, center[0] + half_width), ylim=(center[1] - half_width, center[1] + half_width)
        )
    return figure


def _find_bounding_box(motions: Sequence[Motion]) -> tuple[FloatArray, FloatArray]:
    points = [np.vstack([motion.path, motion.target - motion.radius, motion.target + motion.radius]) for motion in motions]
    for motion in motions:
        if motion.whole is not None:
            center = np.array(motion.whole.centre)
            points.append(np.stack([center - motion.whole.outer, center + motion.whole.outer]))
    everything = np.concatenate(points)
    return everything.min(axis=0), everything.max(axis=0)


def _make_ring_patch(annulus: Ring, **look: Any) -> Circle | Annulus:
    if annulus.inner <= 1e-9:
        return Circle(annulus.centre, annulus.outer, **look)
    width = min(annulus.outer - annulus.inner, annulus.outer * (1 - 1e-9))
    return Annulus(annulus.centre, annulus.outer, max(width, 1e-3 * annulus.outer), **look)
