"""Figure of the certificates of paths."""

from __future__ import annotations

import numpy as np
from concepts import draw_arm, frame_plane
from matplotlib.figure import Figure
from matplotlib.patches import Patch

import holdfast as hf
from holdfast.interface.report import BLUE, ORANGE, SKY, SOFT, settle_layout, style

WIDTH_IN = 8.6
GREY = "#c9d0d6"


def draw_lock_instants() -> Figure:
    """Draw a motion of a planar arm, and for each lock the proved, refuted and undecided fractions of the lock instants."""
    arm = hf.arms.load("planar-3r")
    motion = np.array([0.3, 1.6, 0.7]) + np.linspace(0, 1, 11)[:, None] * [0.2, -1.2, -0.5]
    proof = hf.certify(hf.certificates.path_claim(arm, motion, task="planar"))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.5))
        plane, bars = figure.subplots(1, 2, width_ratios=[1, 1.25])
        for q in motion[[0, 3, 6]]:
            draw_arm(plane, arm, q, color=SKY, width=1.6)
        draw_arm(plane, arm, motion[-1], color=BLUE)
        plane.plot(*arm.forward_kinematics(motion)[:, :2, 3].T, color=ORANGE, lw=1.6, zorder=6)
        frame_plane(plane, "The healthy motion and its path", 3.1)
        plane.set(xlim=(-0.6, 3.1), ylim=(-0.6, 3.1))
        for row, part in enumerate(proof.parts):
            proved, refuted = float(part.proved), float(part.refuted)
            for left, width, color in ((0, refuted, ORANGE), (refuted, 1 - proved - refuted, GREY), (1 - proved, proved, BLUE)):
                bars.barh(row, 100 * width, left=100 * left, height=0.5, color=color)
            bars.text(102, row, f"{100 * proved:.0f} %", va="center", color=SOFT)
        bars.set(yticks=range(len(proof.parts)), yticklabels=[f"joint {part.joint + 1}" for part in proof.parts])
        bars.set(xlim=(0, 112), xticks=range(0, 101, 20), xlabel="fraction of the lock instants, %")
        bars.invert_yaxis()
        bars.set_title("Locked joint; proved fraction at the right")
        names = zip((BLUE, ORANGE, GREY), ("proved", "refuted", "undecided"), strict=True)
        bars.legend(handles=[Patch(color=color, label=name) for color, name in names], loc="upper center",
                    bbox_to_anchor=(0.5, -0.22), ncols=3)  # fmt: skip
        return settle_layout(figure)
