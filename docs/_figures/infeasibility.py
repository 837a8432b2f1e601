"""Figure of the proofs that a goal has no configuration."""

from __future__ import annotations

import numpy as np
from concepts import draw_arm, frame_plane, mark_target
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle, Wedge

import holdfast as hf
from holdfast.interface.report import BLUE, SKY, SOFT, settle_layout, style

WIDTH_IN = 8.6
LOCKED_RAD = np.radians(120.0)  # of joint 2
TARGET = (0.6, 1.1)  # m
SIDE_CELLS = 16


def draw_exclusion() -> Figure:
    """Draw the reach bound of a locked arm, and the boxes of joints in which a pose is excluded."""
    arm = hf.arms.load("planar-3r")
    rigid = 2 * np.cos(LOCKED_RAD / 2)  # links 1 and 2 are one body
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.9))
        plane, joints = figure.subplots(1, 2)
        plane.add_patch(Wedge((0, 0), 1 + rigid, 0, 360, width=1 + rigid - abs(1 - rigid), color="#e6f0f8", ec=SKY))
        draw_arm(plane, arm, np.array([0.3, LOCKED_RAD, -0.6]), color=BLUE, failed=1)
        mark_target(plane, (2.1, 1.2))
        frame_plane(plane, "Reach bound: the target is too far away", 2.9)
        edges = np.linspace(-np.pi, np.pi, SIDE_CELLS + 1)
        half = np.diff(edges)[0] / 2
        for first in edges[:-1] + half:
            for third in edges[:-1] + half:
                tool = arm.forward_kinematics(np.array([first, LOCKED_RAD, third]))[:2, 3]
                change = half * (1 + rigid) + half  # joint 1 moves the tool by at most its reach, joint 3 by its link
                excluded = np.hypot(*(tool - TARGET)) > change
                joints.add_patch(
                    Rectangle(
                        np.degrees([first - half, third - half]), *np.degrees([2 * half, 2 * half]),
                        fc="#eceff2" if excluded else SKY, ec="white", lw=0.8,
                    )
                )  # fmt: skip
        joints.set(xlim=(-180, 180), ylim=(-180, 180), xticks=range(-180, 181, 90), yticks=range(-180, 181, 90))
        joints.set(xlabel="joint 1, deg", ylabel="joint 3, deg", aspect="equal")
        joints.set_title("Boxes: excluded, or bisected again")
        handles = [Patch(fc="#eceff2", ec=SOFT, label="excluded"), Patch(fc=SKY, ec="white", label="not yet decided")]
        joints.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2)
        return settle_layout(figure)
