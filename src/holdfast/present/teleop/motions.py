"""How the end effector went in chosen trials, with what a failure took away of the workspace."""

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
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.report.figures import FAINT, INK, ORANGE, SOFT, WIDTH, finished, plain, style

Array = NDArray[np.float64]

_TIME = LinearSegmentedColormap.from_list("time", ["#b9d6ee", "#0a5c9e", "#04233f"])
_LOST = "#e4e7ea"


@dataclass(frozen=True)
class Ring:
    """What a planar arm reaches: between two circles about a centre, m."""

    centre: tuple[float, float]
    inner: float
    outer: float


def ring(arm: Arm, q: Array, locked: int | None = None) -> Ring | None:
    """What the tool point of a planar arm can reach, with one joint locked at its angle in ``q`` or with none.

    Args:
        arm: The arm.
        q: (n,) configuration, rad.
        locked: Index of the locked joint from 0; None for the healthy arm.

    Returns:
        None unless all axes are parallel to z, all joints turn, and none has a limit: only then is it a ring.
    """
    jacobian = arm.jacobian(q)
    turn = jacobian[5]
    flat = np.allclose(np.abs(turn), 1.0, atol=1e-9) and np.allclose(jacobian[2:5], 0.0, atol=1e-9)
    if arm.prismatic.any() or not flat or not (arm.upper - arm.lower >= 2 * np.pi - 1e-9).all():
        return None
    joints = arm.frames(q)[1:, :2, 3]  # and the tool
    corners = joints if locked is None else np.delete(joints, locked, axis=0)
    links = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    outer = float(links.sum())
    return Ring((float(corners[0, 0]), float(corners[0, 1])), max(0.0, 2 * float(links.max(initial=0.0)) - outer), outer)


@dataclass(frozen=True, kw_only=True)
class Motion:
    """One trial.

    Attributes:
        path: (K, 2) tool points, m.
        title: A few words.
        target: (2,) m.
        radius: Of the target circle, m.
        whole: What the healthy arm reaches; None if that is not drawn.
        left: What is left of it; None if nothing is lost.
    """

    path: Array
    title: str
    target: Array
    radius: float
    whole: Ring | None = None
    left: Ring | None = None


def motions_figure(motions: Sequence[Motion]) -> Figure:
    """Figs 5 to 7: trials side by side, from light to dark, with the lost part of the workspace grey."""
    with style():
        columns = min(4, len(motions))
        lines = -(-len(motions) // columns)
        tall = 0.45 + lines * (WIDTH / columns + 0.3)
        figure = Figure(figsize=(WIDTH, tall))
        figure.set_layout_engine("none")
        place = {"left": 0.055, "right": 0.995, "top": 1 - 0.4 / tall, "bottom": 0.5 / tall, "wspace": 0.06, "hspace": 0.22}
        every = figure.subplots(lines, columns, squeeze=False, sharex=True, sharey=True, gridspec_kw=place).ravel()
        for axes, m in zip(every, motions, strict=False):
            if m.whole is not None:
                face = "white" if m.left is None else _LOST
                axes.add_patch(_patch(m.whole, facecolor=face, edgecolor=SOFT, linewidth=0.9, zorder=0.5))
            if m.whole is not None and m.left is not None:
                axes.add_patch(_patch(m.left, facecolor="white", edgecolor=FAINT, linewidth=0.8, zorder=0.6))
            start = m.path[0]
            axes.plot(
                [start[0], m.target[0]], [start[1], m.target[1]], color=SOFT, linewidth=0.9, linestyle=(0, (4, 3)), zorder=1
            )
            pieces = np.stack([m.path[:-1], m.path[1:]], axis=1)
            lines_ = LineCollection(list(pieces), cmap=_TIME, linewidths=1.5, zorder=3, capstyle="round")
            lines_.set_array(np.linspace(0, 1, max(len(pieces), 1)))
            axes.add_collection(lines_)
            axes.plot([start[0]], [start[1]], "o", color=INK, markersize=4, zorder=4)
            axes.add_patch(
                Circle(
                    (float(m.target[0]), float(m.target[1])), m.radius, fill=False, edgecolor=ORANGE, linewidth=1.6, zorder=4
                )
            )
            axes.set_title(fill(plain(m.title, 48), 26, break_on_hyphens=False), fontsize=8.6, pad=4)
            axes.set_aspect("equal")
            axes.grid(visible=False)
            axes.tick_params(labelsize=8)
        for axes in every[len(motions) :]:
            axes.set_visible(False)
        for axes in every[::columns]:
            axes.set_ylabel("y, m")
        for axes in every[max(0, len(motions) - columns) : len(motions)]:
            axes.set_xlabel("x, m")
        low, high = _extent(motions)
        middle, half = (low + high) / 2, 0.53 * float((high - low).max())
        every[0].set(xlim=(middle[0] - half, middle[0] + half), ylim=(middle[1] - half, middle[1] + half))
        return finished(figure)


def _extent(motions: Sequence[Motion]) -> tuple[Array, Array]:
    points = [np.vstack([m.path, m.target - m.radius, m.target + m.radius]) for m in motions]
    for m in motions:
        if m.whole is not None:
            centre = np.array(m.whole.centre)
            points.append(np.stack([centre - m.whole.outer, centre + m.whole.outer]))
    everything = np.concatenate(points)
    return everything.min(axis=0), everything.max(axis=0)


def _patch(r: Ring, **look: Any) -> Circle | Annulus:
    if r.inner <= 1e-9:
        return Circle(r.centre, r.outer, **look)
    width = min(r.outer - r.inner, r.outer * (1 - 1e-9))
    return Annulus(r.centre, r.outer, max(width, 1e-3 * r.outer), **look)
