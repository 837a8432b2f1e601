"""The self-motion of a Panda: the tool stays, the joints move, and so does what a lock would leave."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import holdfast as hf
from holdfast.interface.report.palette import BLUE, FAINT, INK, ORANGE, SOFT
from holdfast.interface.report.views import View
from tools.loops.film import Shot, caption, figure, picture

OBLIQUE = View(np.array([0.62, 0.78, 0.0]), np.array([-0.23, 0.19, 0.95]), "oblique")


def shots(count: int = 40) -> Iterator[Shot]:
    """There and back along the longest curve of configurations of one pose."""
    arm = hf.arms.load("panda")
    found = hf.self_motion(arm, arm.forward_kinematics(np.array(hf.arms.about("panda").home)))
    q = max(found.components, key=lambda c: c.length).q
    way = np.r_[0, np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1))]
    left = hf.indices.relative_manipulability(arm)(q)
    at = way[-1] * (0.5 - 0.5 * np.cos(np.linspace(0, np.pi, count)))
    chains = OBLIQUE.project(arm.frames(np.stack([np.interp(at, way, x) for x in q.T], axis=1))[..., :3, 3])

    drawn = figure()
    for n in [*range(count), *range(count - 2, 0, -1)]:
        drawn.clear()
        axes = drawn.add_axes((0.0, 0.14, 0.52, 0.84))
        for k in range(0, count, 6):
            axes.plot(*chains[k].T, color=FAINT, linewidth=3, solid_joinstyle="round")
        axes.plot(*chains[n].T, color=INK, linewidth=9, solid_joinstyle="round")
        axes.plot(*chains[n, 1:-1].T, "o", color="white", markersize=11, markeredgecolor=INK, markeredgewidth=2)
        axes.plot(*chains[n, -1], "D", color=ORANGE, markersize=13, markeredgecolor="white")
        axes.plot(*chains[n, 0], "s", color=SOFT, markersize=16)
        low, high = chains.reshape(-1, 2).min(axis=0) - 0.08, chains.reshape(-1, 2).max(axis=0) + 0.08
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        axes.axis("off")
        beside = drawn.add_axes((0.62, 0.30, 0.35, 0.58))
        beside.plot(way, left, color=BLUE, linewidth=3)
        beside.plot(
            at[n], np.interp(at[n], way, left), "D", color=ORANGE, markersize=14, markeredgecolor="white", clip_on=False
        )
        beside.set(xlim=(0, way[-1]), ylim=(0, None))
        beside.set_xlabel("along the self-motion, rad", fontsize=16)
        beside.set_title("left after the worst lock", fontsize=18, weight="bold", color=INK)
        beside.tick_params(labelsize=14)
        beside.spines[["top", "right"]].set_visible(False)
        text = "Self-motion: the tool stays, the joints move\nPanda, all configurations of one pose; relative manipulability"
        yield caption(picture(drawn), text, size=21), 110
