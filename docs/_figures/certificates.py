"""Figures of the certificates, each drawn from a proof that is found when the documentation is built."""

from __future__ import annotations

from itertools import product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

import holdfast as hf
from holdfast.interface.report import BLUE, INK, ORANGE, SKY, SOFT, settle_layout, style

WIDTH_IN = 8.6
CENTRE_CONFIGURATION = np.array([0.1, 0.9])  # rad, of a planar arm with two links of 1 m
TARGET_HALF_WIDTH_M = 0.07
SECTION_HALF_WIDTH_M = 0.025


def draw_proved_box() -> Figure:
    """Draw the boxes of a proof about a target box that crosses the outer boundary of the workspace."""
    arm = hf.arms.load("planar-3r")
    claim = hf.certificates.reach_claim(arm, [2.0, 1.95], 0.7, locked={"joint2": (0.3, 0.4)})
    proof = hf.certify(claim, halvings=5)
    with style():
        return settle_layout(proof.plot())


def draw_brouwer() -> Figure:
    """Draw a target box of a planar arm with two joints, and the image of the section box under s -> s - g."""
    half = TARGET_HALF_WIDTH_M
    inverse = np.linalg.inv(planar_jacobian(CENTRE_CONFIGURATION))
    centre = planar_tool(CENTRE_CONFIGURATION)
    section = SECTION_HALF_WIDTH_M
    grid = np.linspace(-section, section, 25)
    outline = np.array(
        [(x, -section) for x in grid] + [(section, y) for y in grid] + [(x, section) for x in grid[::-1]]
        + [(-section, y) for y in grid[::-1]]
    )  # fmt: skip
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.9))
        plane, sections = figure.subplots(1, 2)
        for corner in product((-half, half), repeat=2):
            draw_planar(plane, solve(centre + corner), SKY, 1.5)
        draw_planar(plane, CENTRE_CONFIGURATION, BLUE, 2.4)
        plane.add_patch(Rectangle(tuple(centre - half), 2 * half, 2 * half, fill=False, ec=ORANGE, lw=1.8, zorder=6))
        plane.set(xlim=(-0.2, 1.9), ylim=(-0.2, 1.4), aspect="equal", xlabel="x, m", ylabel="y, m")
        plane.set_title("Target box (orange) and configurations")
        sections.add_patch(Rectangle((-section, -section), 2 * section, 2 * section, fc="#eceff2", ec=SOFT, lw=1.2))
        for deviation in [*product((-half, half), repeat=2), (0.0, 0.0)]:
            joints = CENTRE_CONFIGURATION + (np.asarray(deviation) + outline) @ inverse.T
            error = planar_tool(joints) - centre - deviation
            sections.fill(*(outline - error).T, fc=SKY, ec=BLUE, lw=1.4, alpha=0.75)
        sections.set(
            xlim=(-0.03, 0.03), ylim=(-0.03, 0.03), aspect="equal", xlabel="section $s_1$, m", ylabel="section $s_2$, m"
        )
        sections.set_title("Section box and its images")
        sections.legend(
            handles=[Patch(fc="#eceff2", ec=SOFT, label="box $S$"), Patch(fc=SKY, ec=BLUE, label="images of $S$")],
            loc="lower left",
        )
        return settle_layout(figure)


def planar_tool(q: np.ndarray) -> np.ndarray:
    """Return the tool positions of an arm with two links of 1 m."""
    angles = np.cumsum(q, axis=-1)
    return np.stack([np.cos(angles).sum(axis=-1), np.sin(angles).sum(axis=-1)], axis=-1)


def planar_jacobian(q: np.ndarray) -> np.ndarray:
    """Return the position Jacobian of this arm."""
    first, both = q[0], q.sum()
    return np.array([[-np.sin(first) - np.sin(both), -np.sin(both)], [np.cos(first) + np.cos(both), np.cos(both)]])


def solve(target: np.ndarray) -> np.ndarray:
    """Return the configuration with the elbow to the right that reaches a target."""
    elbow = np.arccos(target @ target / 2 - 1)
    return np.array([np.arctan2(target[1], target[0]) - elbow / 2, elbow])


def draw_planar(axes: Axes, q: np.ndarray, color: str, width: float) -> None:
    """Draw the arm at a configuration."""
    elbow = np.array([np.cos(q[0]), np.sin(q[0])])
    points = np.array([[0.0, 0.0], elbow, planar_tool(q)])
    axes.plot(*points.T, color=color, lw=width, solid_capstyle="round", zorder=3)
    axes.plot(*points[:-1].T, "o", color="white", mec=color, ms=5, zorder=4)
    axes.plot(*points[-1], ".", color=INK, ms=4, zorder=7)
