"""Figures about recoveries and their proofs, each drawn from a computation on a small arm."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from concepts import WIDTH_IN, draw_arm, frame_plane
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from scipy.ndimage import label

import holdfast as hf
from holdfast.interface.report import BLUE, GREEN, ORANGE, SOFT, settle_layout, style

BALL_CENTERS_M = ((2.6, 0.4), (1.0, 0.5), (-1.0, -0.6))
BALL_RADIUS_M = 0.2
LINK_RADIUS_M = 0.02
LOCKED_ANGLE_RAD = 0.4
START = (-0.9, 0.3)  # rad, joints 1 and 3
GOAL = (1.5, 0.3)
GRID_POINTS = 241


def draw_flood() -> Figure:
    """Draw the free configurations of a planar arm with a locked joint, and those that are connected to the start."""
    arm = hf.arms.load("planar-3r")
    angles = np.linspace(-np.pi, np.pi, GRID_POINTS)
    first, third = np.meshgrid(angles, angles)
    q = np.stack([first, np.full_like(first, LOCKED_ANGLE_RAD), third], axis=-1)
    free = ~np.any([_collides(q, center) for center in BALL_CENTERS_M], axis=0)
    parts, _ = label(free)
    start_cell = tuple(np.abs(angles - value).argmin() for value in reversed(START))
    shown = np.where(parts == parts[start_cell], 2, np.where(free, 1, 0))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.9))
        plane, joints = figure.subplots(1, 2)
        for center in BALL_CENTERS_M:
            plane.add_patch(Circle(center, BALL_RADIUS_M, color=SOFT))
        for (joint1, joint3), color in ((START, BLUE), (GOAL, GREEN)):
            draw_arm(plane, arm, np.array([joint1, LOCKED_ANGLE_RAD, joint3]), color=color, failed=1)
        frame_plane(plane, "Start (blue) and goal (green)", 3.1)
        joints.imshow(
            shown, origin="lower", extent=(-180, 180, -180, 180), cmap=ListedColormap(["#c3cad0", "white", "#bfe0f5"]),
            vmin=0, vmax=2, interpolation="nearest", aspect="equal",
        )  # fmt: skip
        joints.plot(*np.degrees(START), "o", color=BLUE, ms=7)
        joints.plot(*np.degrees(GOAL), "x", color=GREEN, ms=8, mew=2.4)
        joints.set(xlabel="joint 1, deg", ylabel="joint 3, deg", xticks=range(-180, 181, 90), yticks=range(-180, 181, 90))
        joints.set_title("Connected to the start (light blue)")
        return settle_layout(figure)


def _collides(q: np.ndarray, center: tuple[float, float]) -> np.ndarray:
    """Return True where a link of 1 m comes too near to a ball, for configurations (..., 3)."""
    heading = np.cumsum(q, axis=-1)
    steps = np.stack([np.cos(heading), np.sin(heading)], axis=-1)
    begins = np.concatenate([np.zeros_like(steps[..., :1, :]), np.cumsum(steps, axis=-2)[..., :-1, :]], axis=-2)
    along = np.clip(((np.asarray(center) - begins) * steps).sum(axis=-1), 0, 1)[..., None]
    distance = np.linalg.norm(begins + along * steps - np.asarray(center), axis=-1)
    return np.asarray((distance < BALL_RADIUS_M + LINK_RADIUS_M).any(axis=-1))


def draw_timing() -> Figure:
    """Draw the joint velocities of a timed recovery along a line."""
    arm = hf.arms.load("panda")
    at = np.array([2.0, 0.6, 0.0, -2.0, 0.0, 2.5, 0.8])
    path = hf.paths.line(arm.forward_kinematics(at), np.array([-0.1, 0.35, 0.4]))
    timed = hf.recover(arm, ["panda_joint4"], at, path=path, task="position", samples=0, accelerations=10.0).timed
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.2))
        axes = figure.subplots()
        for joint, velocity in enumerate(np.gradient(timed.q, timed.time, axis=0).T):
            if np.abs(velocity).max() > 1e-6:
                axes.plot(timed.time, velocity, label=f"joint {joint + 1}")
        axes.set(xlabel="time, s", ylabel="joint velocity, rad/s", xlim=(0, timed.time[-1]))
        axes.legend(ncols=3)
        return settle_layout(figure)


def draw_tilt() -> Figure:
    """Draw the tilt of the tool along a recovery with and without an upright constraint."""
    arm = hf.arms.load("panda")
    at = np.array([1.92, 1.35, 2.63, -1.39, -1.44, 0.5, 0.98])
    goal = arm.forward_kinematics(np.array([1.16, -0.04, 2.63, -3.07, 0.52, 3.1, 2.64]))
    cone = hf.tool_constraints.upright(np.deg2rad(5))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.0))
        axes = figure.subplots()
        for keep, color, name in ((None, ORANGE, "without a constraint"), (cone, BLUE, "inside a cone of 5 deg")):
            options = {} if keep is None else {"keep": keep}
            q = hf.recover(arm, ["panda_joint3"], at, goal=goal, clearance=False, samples=0, **options).q
            steps = np.linspace(0, 1, 41)[:, None]
            motion = np.vstack([a + steps * (b - a) for a, b in pairwise(q)])
            travel = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(motion, axis=0), axis=1))])
            tilt = np.rad2deg(np.arccos(np.clip(-arm.forward_kinematics(motion)[:, 2, 2], -1, 1)))
            axes.plot(travel, tilt, color=color, label=name)
        axes.axhline(5, color=SOFT, lw=0.8)
        axes.set(xlabel="travel in joint space, rad", ylabel="tilt of the tool, deg", xlim=(0, None), ylim=(0, None))
        axes.legend()
        return settle_layout(figure)
