"""Planar arms on paper."""

from __future__ import annotations

import textwrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.interface.report import INK, ORANGE, SOFT

Array = NDArray[np.float64]

DASHED, DOTTED = (0, (4.5, 2)), (0, (1.2, 1.6))


def joints(q: Array) -> Array:
    """(..., n + 1, 2) places of the joints and the end effector of an arm with unit links."""
    direction = np.cumsum(q, axis=-1)
    steps = np.stack([np.cos(direction), np.sin(direction)], axis=-1)
    return np.concatenate([np.zeros_like(steps[..., :1, :]), np.cumsum(steps, axis=-2)], axis=-2)


def arm(axes: Axes, q: Array, locked: int | None = None, color: str = INK, width: float = 2.0) -> None:
    """A pose of the arm; the locked joint, from 0, is filled."""
    places = joints(q)
    axes.plot(*places.T, "-", color=color, linewidth=width, solid_capstyle="round", zorder=3)
    axes.plot(*places[:-1].T, "o", color=color, markersize=5, markerfacecolor="white", zorder=4)
    if locked is not None:
        axes.plot(*places[locked], "o", color=ORANGE, markersize=7, zorder=5)


def target(axes: Axes, place: Array, text: str = "") -> None:
    """A cross where the end effector should go."""
    axes.plot(*place, "x", color=ORANGE, markersize=8, markeredgewidth=2, zorder=6)
    if text:
        axes.annotate(text, point(place), (7, 5), textcoords="offset points", color=ORANGE)


def point(place: Array) -> tuple[float, float]:
    """As matplotlib's annotations want it."""
    return float(place[0]), float(place[1])


def plane(axes: Axes, reach: float, title: str = "") -> None:
    """Axes of the plane, in m."""
    axes.set(aspect="equal", xlabel="x, m", ylabel="y, m", title=title, xlim=(-reach, reach), ylim=(-reach, reach))


def caption(figure: Figure, text: str, width: int = 110) -> None:
    """Under everything else."""
    figure.supxlabel("\n".join(textwrap.wrap(text, width)), fontsize=9, color=SOFT)
