"""The elbow of a Panda loses its torque: without a brake, and with one that acts after 150 ms. Simulated by MuJoCo."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import holdfast as hf
from holdfast.interface.report.palette import BLUE, FAINT, INK, ORANGE, PURPLE, SOFT
from tools.loops.film import Shot, caption, figure, picture

JOINT, BRAKE = "panda_joint4", 150.0  # ms
START = np.deg2rad([0, -20, 0, -100, 0, 80, 45])
SECONDS, SLOWER = 0.6, 8.0


def shots(count: int = 50) -> Iterator[Shot]:
    """Both arms at the same instants; at the end both stand for a while."""
    arm = hf.arms.load("panda")
    swing = hf.free_swing(arm, START, JOINT, limits=True, brake_after=(BRAKE,))
    k, caught = arm.joint_names.index(JOINT), swing.drops[0]
    instants = np.linspace(0, SECONDS, count)
    moved = np.interp(instants, swing.time, swing.angle)
    braked = np.where(instants * 1000 < BRAKE, moved, caught.angle)
    low = float(np.interp(instants, swing.time, swing.tool_position[:, 2]).min())

    drawn = figure()
    for n, (t, free, held) in enumerate(zip(instants, moved, braked, strict=True)):
        drawn.clear()
        for side, (angle, title) in enumerate(((free, "no brake"), (held, f"brake after {BRAKE:.0f} ms"))):
            axes = drawn.add_axes((0.02 + 0.49 * side, 0.15, 0.47, 0.70))
            q = START.copy()
            q[k] += angle
            for where, color, width in ((START, FAINT, 6), (q, INK, 7)):
                chain = arm.frames(where)[:, :3, 3]
                axes.plot(chain[:, 0], chain[:, 2], color=color, linewidth=width, solid_joinstyle="round")
            on = not side or t * 1000 < BRAKE
            axes.plot(*chain[k + 1, [0, 2]], "o", color=PURPLE if on else BLUE, markersize=16, markeredgecolor="white")
            past = instants[: n + 1] if not side else np.minimum(instants[: n + 1], BRAKE / 1000)
            way = np.stack([np.interp(past, swing.time, x) for x in swing.tool_position.T], axis=1)
            axes.plot(way[:, 0], way[:, 2], color=ORANGE, linewidth=3)
            axes.plot(*chain[-1, [0, 2]], "D", color=ORANGE, markersize=10, markeredgecolor="white")
            fallen = 1000 * (swing.tool_position[0, 2] - way[-1, 2])
            axes.set_title(f"{title}\ntool {fallen:.0f} mm down", fontsize=18, color=INK, weight="bold")
            axes.axhline(0, color=SOFT, linewidth=1)
            axes.set(xlim=(-0.62, 0.78), ylim=(min(low, 0) - 0.06, 0.95), aspect="equal")
            axes.axis("off")
        last = n == count - 1
        text = f"Joint 4 swings free, all others hold   {t:4.2f} s\n"
        text += f"Panda, MuJoCo, with its joint limits; {SLOWER:.0f} times slower than it is"
        ms = 2200 if last else 900 if n == 0 else round(SECONDS / count * SLOWER * 1000)
        yield caption(picture(drawn), text, size=21), ms
