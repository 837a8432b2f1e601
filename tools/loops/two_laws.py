"""A joint is locked and the controller does not know: the same motion under two control laws."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import holdfast as hf
from holdfast.interface.report.palette import BLUE, FAINT, INK, ORANGE, SOFT
from tools.loops.film import Shot, caption, figure, picture

START, TARGET, JOINT = np.deg2rad([-70.0, 40.0, 24.0]), (0.70, 0.53), "joint3"
SECONDS = 16.0  # 1/Ke
FINE = 8  # times as many samples of a motion as pictures


def shots(count: int = 54) -> Iterator[Shot]:
    """Both arms at the same instants."""
    arm = hf.arms.load("planar-3r")
    laws = {
        "pseudoinverse": hf.control.pseudoinverse(arm, "planar"),
        "failure-tolerant": hf.control.failure_tolerant(arm, "planar", pre_failure_error=0.5),
    }
    runs = [hf.simulate(law, START, TARGET, locked=[JOINT]) for law in laws.values()]
    paths = [run.path(samples=FINE * (count - 1) + 1, until=SECONDS) for run in runs]
    chains = [arm.frames(path.q)[..., :3, 3] for path in paths]

    drawn = figure()
    for n in range(0, len(paths[0].time), FINE):
        drawn.clear()
        for side, (name, path, chain) in enumerate(zip(laws, paths, chains, strict=True)):
            axes = drawn.add_axes((0.02 + 0.49 * side, 0.16, 0.47, 0.74))
            axes.plot(*chain[0, :, :2].T, color=FAINT, linewidth=6, solid_joinstyle="round")
            axes.plot(*chain[: n + 1, -1, :2].T, color=BLUE, linewidth=2.5)
            axes.plot(*chain[n, :, :2].T, color=INK, linewidth=7, solid_joinstyle="round")
            axes.plot(*chain[n, 1:-1, :2].T, "o", color="white", markersize=11, markeredgecolor=INK, markeredgewidth=2)
            axes.plot(*chain[n, 3, :2], "o", color=ORANGE, markersize=15, markeredgecolor=INK, markeredgewidth=2)
            axes.plot(*TARGET, "o", fillstyle="none", color=ORANGE, markersize=22, markeredgewidth=3)
            axes.plot(0, 0, "s", color=SOFT, markersize=14)
            axes.set_title(f"{name}: {path.error[n]:.2f} m off", fontsize=19, weight="bold", color=INK)
            axes.set(xlim=(-1.6, 2.4), ylim=(-2.0, 1.3), aspect="equal")
            axes.axis("off")
        text = f"Joint 3 is locked, and the controller does not know   {path.time[n]:4.1f} s\n"
        text += "one motion of many, three links of 1 m; the ring is the target"
        yield caption(picture(drawn), text, size=21), 1500 if path.time[n] >= SECONDS else 120
