"""Figures about motions that survive a lock, and about the identification of a locked joint."""

from __future__ import annotations

import numpy as np
from concepts import WIDTH_IN
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import BLUE, ORANGE, settle_layout, style

LIMITS_RAD = ((-1.2, 1.0), (-1.6, 2.0), (-1.2, 2.2))
SAMPLES = 41


def draw_survival() -> Figure:
    """Draw the survival over time of the planned motion and of the least-norm motion."""
    joints = [hf.DH(a=1.0, alpha=0.0, lower=low, upper=high) for low, high in LIMITS_RAD]
    arm = hf.Arm.from_dh(joints, name="narrow")
    line = hf.paths.line([1.6, -0.9, 0.0], [1.1, 1.3, 0.0])
    path = hf.paths.TimedPath(line, hf.paths.Trapezoid(2.0))
    best = hf.plan_motion(arm, path, samples=SAMPLES, compare=["least-norm"])
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.2))
        axes = figure.subplots()
        axes.plot(best.time, 100 * best.curve(), color=BLUE, label=f"planned motion: {100 * best.survival:.0f} % on average")
        for other in best.comparisons:
            axes.plot(
                best.time,
                100 * np.asarray(other.curve),
                color=ORANGE,
                label=f"{other.name}: {100 * other.survival:.0f} % on average",
            )
        axes.set(xlabel="time of the lock, s", ylabel="survived, % of the joints", xlim=(0, 2), ylim=(-3, 105))
        axes.legend(loc="lower right")
        return settle_layout(figure)


def draw_identification() -> Figure:
    """Draw how far the tool leaves its pose during an identification motion, for each joint that may be locked."""
    arm = hf.arms.load("panda")
    probe = hf.diagnosis.plan_identification(arm, [0, -0.4, 0.3, -2, 0.2, 1.8, 0.5])
    held = arm.forward_kinematics(probe.q[0])[:3, 3]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.2))
        motion, tool = figure.subplots(1, 2)
        for joint in range(arm.n):
            line = motion.plot(probe.t, np.degrees(probe.q[:, joint] - probe.q[0, joint]), label=f"joint {joint + 1}")[0]
            q = probe.q.copy()
            q[:, joint] = q[0, joint]
            distance = np.linalg.norm(arm.forward_kinematics(q)[:, :3, 3] - held, axis=1)
            tool.plot(probe.t, 1e3 * distance, color=line.get_color())
        motion.set(xlabel="time, s", ylabel="joint motion, deg", xlim=(0, probe.t[-1]))
        motion.set_title("Self-motion")
        tool.set(xlabel="time, s", ylabel="tool displacement, mm", xlim=(0, probe.t[-1]), ylim=(0, None))
        tool.set_title("Displacement if this joint is locked")
        figure.legend(*motion.get_legend_handles_labels(), loc="outside lower center", ncols=7)
        return settle_layout(figure)
