"""Figures of the upper bounds of relative manipulability."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import BLUE, GREEN, INK, ORANGE, SOFT, settle_layout, style

WIDTH_IN = 8.6
TASK_COMPONENTS = 6


def draw_bounds() -> Figure:
    """Draw proved bounds and best known values of poses over the number of joints."""
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.5))
        axes = figure.subplots()
        for locks, color in ((1, BLUE), (2, ORANGE), (3, GREEN)):
            joints = list(range(TASK_COMPONENTS + locks, 11))
            bounds = [hf.index_bounds.upper_bound(n=n, m=TASK_COMPONENTS, k=locks) for n in joints]
            axes.plot(joints, [bound.bound for bound in bounds], color=color, label=f"{locks} lock{'s'[: locks > 1]}: bound")
            axes.plot(joints, [bound.best_known for bound in bounds], "o", color=color, label="best known")
        axes.set(xlabel="joints", ylabel="relative manipulability, worst case", xticks=range(7, 11), ylim=(0, 0.7))
        axes.set_title("Largest relative manipulability after the worst lock, pose")
        axes.legend(loc="upper left", ncols=3)
        return settle_layout(figure)


def draw_star() -> Figure:
    """Draw the regular star of five lines, and a random arrangement, with the two lines of the smallest minor."""
    regular = np.sqrt(2 / 5) * np.column_stack([f(np.arange(5) * np.pi / 5 + 0.2) for f in (np.cos, np.sin)])
    random, _ = np.linalg.qr(np.random.default_rng(4).normal(size=(5, 2)))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.6))
        for axes, rows, name in zip(figure.subplots(1, 2), (regular, random), ("Regular star", "Random lines"), strict=True):
            draw_lines(axes, rows, name)
        return settle_layout(figure)


def draw_lines(axes: Axes, rows: np.ndarray, name: str) -> None:
    """Draw weighted lines of the plane, and mark the pair with the smallest minor."""
    pairs = [(i, j) for i in range(len(rows)) for j in range(i)]
    minors = [abs(np.linalg.det(rows[list(pair)])) for pair in pairs]
    worst = pairs[int(np.argmin(np.round(minors, 9)))]
    for index, row in enumerate(rows):
        axes.plot(*np.array([-row, row]).T, color=ORANGE if index in worst else BLUE, lw=2.2)
        axes.text(*(row * (1 + 0.07 / np.linalg.norm(row))), f"{index + 1}", color=INK, ha="center", va="center")
    circle = np.linspace(0, 2 * np.pi, 100)
    axes.plot(np.sqrt(2 / 5) * np.cos(circle), np.sqrt(2 / 5) * np.sin(circle), color=SOFT, lw=0.8, linestyle=(0, (4, 3)))
    axes.set(xlim=(-0.95, 0.95), ylim=(-0.95, 0.95), aspect="equal")
    axes.set_axis_off()
    axes.set_title(f"{name}: smallest minor {min(minors):.3f}")


def draw_workspace_bound() -> Figure:
    """Draw the bound W1 of the failure-tolerant workspace over the length of the first link."""
    first = np.linspace(0, 1 / 3, 200)
    area = 4 * np.pi * first * (1 - 3 * first)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.1))
        axes = figure.subplots()
        axes.plot(first, area / np.pi, color=BLUE)
        axes.plot([1 / 6], [1 / 3], "o", color=ORANGE)
        axes.annotate("best first link: L/6", (1 / 6, 1 / 3), (0.2, 0.345), color=ORANGE)
        axes.set(xlabel="first link / L", ylabel="bound / area of the disk", xlim=(0, 0.345), ylim=(0, 0.4))
        axes.set_title("Largest failure-tolerant workspace of a planar arm with three joints")
        return settle_layout(figure)
