"""A basin map grows: from each start, the solution that the arm with a locked joint reaches."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.colors import ListedColormap

import holdfast as hf
from holdfast.interface.report.palette import INK, LIGHT_BLUE, ORANGE
from tools.loops.film import TICK, Shot, caption, figure, picture

TARGET, LOCKED = (1.5, 1.5), {"joint2": np.deg2rad(45)}
CELLS, NEAR = 60, 0.05  # m: where a start counts as there
COLORS = ListedColormap(["#f3e9e2", "#a9cbe6", "#f0b48a"])

WORDS = """Joint 2 is locked at 45°.
The controller does
not know.

Dots: starts on their way.
Rings: the two ways to
reach the target.
Colour: which one."""


def shots(count: int = 70) -> Iterator[Shot]:
    """Starts flow along the closed loop; their cells are coloured when they are there."""
    arm = hf.arms.load("planar-3r")
    law = hf.control.pseudoinverse(arm, "planar")
    found = hf.basins(law, TARGET, LOCKED, grid=CELLS)
    solutions = [k for k, kind in enumerate(found.points.kinds) if kind == "solution"]
    end = np.array([1 + solutions.index(k) for k in found.end])
    q, there = found.starts, np.zeros(len(end), dtype=bool)
    few = np.random.default_rng(0).permutation(len(end))[:260]

    drawn = figure()
    for n in range(count):
        last = n == count - 1
        there |= last
        drawn.clear()
        axes = drawn.add_axes((0.40, 0.13, 0.58, 0.84))
        cells = np.where(there, end, 0).reshape(found.shape)
        axes.imshow(
            cells.T, origin="lower", extent=(-180, 180, -180, 180), cmap=COLORS, vmin=0, vmax=2, interpolation="nearest"
        )
        on = np.rad2deg((q[few] + np.pi) % (2 * np.pi) - np.pi)
        axes.plot(on[:, 0], on[:, 2], ".", color=INK, markersize=5)
        for k in solutions:
            place = np.rad2deg(found.points.q[k])
            color = (LIGHT_BLUE, ORANGE)[solutions.index(k)]
            axes.plot(place[0], place[2], "o", color=color, markersize=16, markeredgecolor=INK, markeredgewidth=2)
        axes.set(xlim=(-180, 180), ylim=(-180, 180), xticks=range(-180, 181, 90), yticks=range(-180, 181, 90), aspect="equal")
        axes.set_xlabel("joint 1, deg", fontsize=16)
        axes.set_ylabel("joint 3, deg", fontsize=16)
        axes.tick_params(labelsize=14)
        drawn.text(0.02, 0.93, "Where does it end?", fontsize=22, weight="bold", color=INK, va="top")
        drawn.text(0.02, 0.84, WORDS, fontsize=17, color=INK, va="top", linespacing=1.4)
        reached = f"{np.mean(there):.0%} of {len(end)} starts are there"
        yield caption(picture(drawn), reached, size=19), 2500 if last else TICK
        run = hf.simulate(law, q, TARGET, locked=list(LOCKED), time_limit=0.1 * 1.04**n)
        q, there = run.q_final, there | (run.error < NEAR)
