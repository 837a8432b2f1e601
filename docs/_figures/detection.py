"""Figures about the detection and isolation of joint faults."""

from __future__ import annotations

import numpy as np
from concepts import WIDTH_IN
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

import holdfast as hf
from holdfast.interface.report import BLUE, GREEN, INK, ORANGE, SOFT, settle_layout, style
from holdfast.response.diagnosis import EXCESS_LIMITS_S, ISOLATION_TIME_S

LOCK_TIME_S = 1.5
DURATION_S = 2.2
LOCKED_JOINT = 2


def draw_residuals() -> Figure:
    """Draw scaled torque residuals of a simulated lock, and their accumulated excess."""
    arm = hf.arms.load("panda")
    friction = {"coulomb": [0.5] * 7, "viscous": [0.3] * 7}
    healthy = [hf.diagnosis.simulate_log(arm, DURATION_S, seed=seed, robot=0) for seed in range(3)]
    bounds = hf.diagnosis.calibrate(arm, healthy, **friction)
    fault = hf.faults.FaultEvent("locked", arm.joint_names[LOCKED_JOINT], LOCK_TIME_S)
    log = hf.diagnosis.simulate_log(arm, DURATION_S, seed=9, robot=0, faults=[fault])
    found = hf.diagnosis.diagnose(arm, log, bounds)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 4.2))
        residuals, excess = figure.subplots(2, 1, sharex=True)
        shown = (log.t > LOCK_TIME_S - 0.03) & (log.t < LOCK_TIME_S + 0.06)
        time = 1e3 * (log.t[shown] - LOCK_TIME_S)
        for joint in range(arm.n):
            color, label = (ORANGE, "joint 3") if joint == LOCKED_JOINT else (SOFT, "other joints" if joint == 0 else None)
            residuals.plot(
                time, found.scaled.torque[shown, joint], color=color, lw=1.6 if label == "joint 3" else 0.9, label=label
            )
        residuals.axhline(1, color=INK, lw=0.8, linestyle=(0, (4, 2)))
        residuals.set(ylabel="residual / threshold", ylim=(0, 4))
        residuals.legend(loc="upper left")
        excess.plot(time, 1e3 * found.scaled.excess["torque"][shown, LOCKED_JOINT], color=ORANGE)
        excess.axhline(1e3 * EXCESS_LIMITS_S["torque"], color=INK, lw=0.8, linestyle=(0, (4, 2)))
        excess.set(xlabel="time after the lock, ms", ylabel="excess, ms", xlim=(time[0], time[-1]), ylim=(0, 30))
        alarm = 1e3 * (found.verdict.time - LOCK_TIME_S)
        for axes in (residuals, excess):
            axes.axvline(0, color=SOFT)
            axes.axvline(alarm, color=BLUE)
            axes.axvline(alarm + 1e3 * ISOLATION_TIME_S, color=GREEN)
        excess.annotate(f"alarm after {alarm:.0f} ms", (alarm, 24), (alarm + 1, 24), color=BLUE, va="center")
        isolation = alarm + 1e3 * ISOLATION_TIME_S
        excess.annotate(
            f"joint isolated after {isolation:.0f} ms", (isolation, 24), (isolation + 1, 24), color=GREEN, va="center"
        )
        return settle_layout(figure)


def draw_controller() -> Figure:
    """Draw the signals between the robot, the monitor, the response and the control law."""
    boxes = {
        "control law": (2.2, 1.5, BLUE),
        "servos and robot": (5.2, 1.5, SOFT),
        "monitor": (5.2, 0.2, ORANGE),
        "response": (2.2, 0.2, GREEN),
    }
    arrows = [
        ((0.4, 1.5), (1.45, 1.5), "twist"),
        ((2.95, 1.5), (4.35, 1.5), "joint rates"),
        ((5.2, 1.18), (5.2, 0.52), "  positions, references,\n  torques, tool pose"),
        ((4.35, 0.2), (2.95, 0.2), "verdict"),
        ((2.2, 0.52), (2.2, 1.18), "excluded joints, speed  "),
    ]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 2.6))
        axes = figure.subplots()
        for name, (x, y, color) in boxes.items():
            half = 0.85 if "robot" in name or name == "monitor" else 0.75
            axes.add_patch(
                FancyBboxPatch((x - half, y - 0.3), 2 * half, 0.6, boxstyle="round,pad=0.02", fc="white", ec=color, lw=1.8)
            )
            axes.text(x, y, name, ha="center", va="center")
        for begin, end, text in arrows:
            axes.annotate("", end, begin, arrowprops={"arrowstyle": "->", "color": INK, "lw": 1.2})
            middle = (np.array(begin) + end) / 2
            if begin[0] == end[0]:
                axes.text(*middle, text, ha="left" if text.startswith(" ") else "right", va="center", fontsize=8.6)
            else:
                axes.text(middle[0], middle[1] + 0.08, text, ha="center", va="bottom", fontsize=8.6)
        axes.set(xlim=(0, 8), ylim=(-0.3, 2))
        axes.set_axis_off()
        return settle_layout(figure)
