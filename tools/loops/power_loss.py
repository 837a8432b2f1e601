"""A Panda loses its power: without brakes, and with brakes that act after 100 ms. Simulated by the batch engine."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import holdfast as hf
from holdfast.interface.report.palette import BLUE, FAINT, INK, ORANGE, PURPLE, SOFT
from tools.loops.film import Shot, caption, figure, picture

BRAKE_S, BRAKE_TORQUE = 0.1, 40.0
START = np.deg2rad([0, -20, 0, -100, 0, 80, 45])
SECONDS, SLOWER = 0.45, 8.0
FRICTION = hf.Friction(coulomb=0.5, viscous=0.5)


def shots(count: int = 50) -> Iterator[Shot]:
    """Both arms at the same instants; at the end both stand for a while."""
    arm = hf.arms.load("panda")
    brakes = hf.Brakes(after=BRAKE_S, torque=BRAKE_TORQUE)
    falls = [hf.power_loss(arm, START, friction=FRICTION, brakes=each, duration=SECONDS) for each in (None, brakes)]
    instants = np.linspace(0, SECONDS, count)
    motions, tools, drops = ([values(fall) for fall in falls] for values in (
        lambda fall: fall.q_at(instants), lambda fall: fall.tool_at(instants), lambda fall: 1000 * fall.drop_at(instants)
    ))  # fmt: skip
    low = min(float(tool[:, 2].min()) for tool in tools)

    drawn = figure()
    for n, t in enumerate(instants):
        drawn.clear()
        for side, title in enumerate(("no brakes", f"brakes after {1000 * BRAKE_S:.0f} ms")):
            axes = drawn.add_axes((0.02 + 0.49 * side, 0.15, 0.47, 0.70))
            for where, color, width in ((START, FAINT, 6), (motions[side][n], INK, 7)):
                chain = arm.frames(where)[:, :3, 3]
                axes.plot(chain[:, 0], chain[:, 2], color=color, linewidth=width, solid_joinstyle="round")
            joint_color = PURPLE if not side or t < BRAKE_S else BLUE
            axes.plot(*chain[1:-1, [0, 2]].T, "o", color=joint_color, markersize=13, markeredgecolor="white")
            axes.plot(tools[side][: n + 1, 0], tools[side][: n + 1, 2], color=ORANGE, linewidth=3)
            axes.plot(*chain[-1, [0, 2]], "D", color=ORANGE, markersize=10, markeredgecolor="white")
            axes.set_title(f"{title}\ntool {drops[side][n]:.0f} mm down", fontsize=18, color=INK, weight="bold")
            axes.axhline(0, color=SOFT, linewidth=1)
            axes.set(xlim=(-0.62, 0.78), ylim=(min(low, 0) - 0.06, 0.95), aspect="equal")
            axes.axis("off")
        text = f"All joints lose their torque   {t:4.2f} s\n"
        text += f"Panda, simulated, brakes of {BRAKE_TORQUE:.0f} N m; {SLOWER:.0f} times slower than it is"
        ms = 2200 if n == count - 1 else 900 if n == 0 else round(SECONDS / count * SLOWER * 1000)
        yield caption(picture(drawn), text, size=21), ms
