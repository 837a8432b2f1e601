"""Figures of the guides that prepare an arm for a lock, each drawn from a computation when the documentation is built."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from concepts import WIDTH_IN, draw_arm
from matplotlib.figure import Figure

import holdfast as hf
from holdfast.interface.report import BLUE, GREEN, INK, ORANGE, SKY, SOFT, settle_layout, style

PA10_Q = np.deg2rad([0, 30, 0, 90, 0, 18, 0, 36, 0])
PANDA_Q = np.deg2rad([0, -45, 0, -135, 0, 90, 45])
BENCH_LENGTH_M = 1.9
GANTRY = """<robot name="gantry"><link name="world"/><link name="carriage"/><link name="upper"/><link name="fore"/>
<link name="wrist"/><link name="camera"/>
<joint name="rail" type="prismatic"><parent link="world"/><child link="carriage"/><axis xyz="0 1 0"/>
  <limit lower="0" upper="1.5" velocity="0.5" effort="400"/></joint>
<joint name="base" type="revolute"><parent link="carriage"/><child link="upper"/><origin xyz="0 0 0.3"/><axis xyz="0 0 1"/>
  <limit lower="-3" upper="3" velocity="2" effort="80"/></joint>
<joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.4 0 0"/><axis xyz="0 0 1"/>
  <limit lower="-2.5" upper="2.5" velocity="2" effort="80"/></joint>
<joint name="wrist" type="continuous"><parent link="fore"/><child link="wrist"/><origin xyz="0.35 0 0"/>
  <axis xyz="0 0 1"/></joint>
<joint name="camera_mount" type="fixed"><parent link="wrist"/><child link="camera"/><origin xyz="0.1 0 0"/></joint></robot>"""


def draw_choices() -> Figure:
    """Draw the index along all configurations of one pose of a Panda."""
    arm = hf.arms.load("panda")
    index = hf.indices.relative_manipulability(arm)
    pose = arm.forward_kinematics(PANDA_Q)
    motion = hf.self_motion(arm, pose)
    best = hf.optimise(arm, pose, index, seed=1)
    found = float(best.start_value)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.3))
        axes = figure.subplots()
        start = 0
        for number, (curve, color) in enumerate(zip(motion.components, (BLUE, GREEN, SKY), strict=False), 1):
            values = index(curve.q)
            place = np.arange(start, start + len(values))
            axes.plot(place, values, color=color, label=f"curve {number}")
            start += len(values) + 12
        axes.axhline(found, color=ORANGE, linestyle=(0, (4, 2)), label=f"first configuration found: {found:.3f}")
        axes.axhline(best.value, color=INK, linestyle=(0, (1, 1)), label=f"chosen by optimise: {best.value:.3f}")
        axes.set(xlabel="configuration along the self-motion", ylabel="worst-case relative\nmanipulability", ylim=(0, None))
        axes.set_xticks([])
        axes.set_title("All configurations of one tool pose of a Panda")
        figure.legend(loc="outside lower center", ncols=3)
        return settle_layout(figure)


def draw_path_comparison() -> Figure:
    """Draw the susceptibility along a path for a prepared motion, a capped one and the least-norm motion."""
    arm = hf.arms.load("planar-3r")
    torque = hf.susceptibility.torque(arm, "worst-case")
    text = f"""
line:
  from: {{xyz: [{BENCH_LENGTH_M}, -{BENCH_LENGTH_M}, 0]}}
  to: {{xyz: [-{BENCH_LENGTH_M}, -{BENCH_LENGTH_M}, 0]}}
timing: {{duration: 20}}
"""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "bench.yaml"
        file.write_text(text, encoding="utf-8")
        path = hf.paths.TimedPath.load(file)
    options = {"minimise": torque, "task": "planar", "samples": 201}
    prepared = hf.follow(arm, path, rate_cap=1.0, **options)
    plain = hf.follow(arm, path, method="none", q=prepared.q[0], **options)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.5))
        plane, values = figure.subplots(1, 2, width_ratios=[1, 1.2])
        for motion, color, name in ((plain, ORANGE, "least-norm motion"), (prepared, BLUE, "prepared motion")):
            for row in (0, 70, 120):
                draw_arm(plane, arm, motion.q[row], color=color, width=1.6)
            values.plot(motion.time, motion.value, color=color, label=name)
        plane.plot([BENCH_LENGTH_M, -BENCH_LENGTH_M], [-BENCH_LENGTH_M] * 2, color=INK, lw=1.2, zorder=1)
        plane.set(xlim=(-1.1, 2.1), ylim=(-2.2, 0.5), aspect="equal", xlabel="x, m", ylabel="y, m")
        plane.set_title("The arm at 0 s, 7 s and 12 s")
        values.set(xlabel="time, s", ylabel="torque susceptibility", xlim=(0, 20), ylim=(0, None))
        values.set_title("Worst joint; a smaller value is better")
        values.legend(loc="upper center")
        return settle_layout(figure)


def draw_tasks() -> Figure:
    """Draw the relative manipulability after each lock of a nine-joint arm for three tasks."""
    arm = hf.arms.load("pa10-9dof")
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.2))
        axes = figure.subplots()
        for place, (task, color) in enumerate((("pose", BLUE), ("pointing", SKY), ("position", GREEN))):
            index = hf.indices.relative_manipulability(arm, task)
            values = index.by_joint(PA10_Q)
            axes.bar(np.arange(arm.n) + 0.27 * (place - 1), values, width=0.25, color=color, label=task)
            worst = int(np.argmin(values))
            axes.plot(worst + 0.27 * (place - 1), values[worst] + 0.04, "v", color=ORANGE, ms=6)
        axes.plot([], [], "v", color=ORANGE, ms=6, label="worst joint")
        axes.set(xticks=range(arm.n), xticklabels=[f"joint {joint + 1}" for joint in range(arm.n)], ylim=(0, 1.05))
        axes.set(ylabel="relative manipulability\nafter the lock")
        axes.set_title("One configuration of the nine-joint PA10, three tasks")
        figure.legend(loc="outside lower center", ncols=4)
        return settle_layout(figure)


def draw_first_number() -> Figure:
    """Draw the gantry of the guide from above, and the relative manipulability after each lock."""
    q = np.array([0.2, 0.3, 0.5, 0.1])
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "gantry.urdf"
        file.write_text(GANTRY, encoding="utf-8")
        arm = hf.Arm.from_urdf(file)
    values = hf.indices.relative_manipulability(arm, "planar").by_joint(q)
    frames = arm.frames(q)
    points = np.vstack([frames[1:, :2, 3], arm.forward_kinematics(q)[None, :2, 3]])
    names = ("rail", "base", "elbow", "wrist")
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.2))
        plane, bars = figure.subplots(1, 2, width_ratios=[1.1, 1])
        plane.plot([0, 0], [0, 1.5], color=SOFT, lw=5, solid_capstyle="butt")
        plane.plot(*points.T, color=BLUE, lw=2.4)
        plane.plot(*points[:-1].T, "o", color="white", mec=BLUE, ms=6)
        plane.plot(*points[-1], "D", color=INK, ms=5)
        plane.plot(0, q[0], "s", color="white", mec=BLUE, ms=9, zorder=1.5)
        labels = [(names[0], (0.0, 1.1)), (names[1], points[1]), (names[2], points[2]), (names[3], points[3])]
        for name, point in labels:
            plane.annotate(name, point, (8, -12), textcoords="offset points", color=INK)
        plane.annotate("tool point", points[-1], (6, 6), textcoords="offset points", color=INK)
        plane.set(xlim=(-0.2, 1.25), ylim=(-0.05, 1.55), aspect="equal", xlabel="x, m", ylabel="y, m")
        plane.set_title("The chain from above")
        colors = [ORANGE if value == min(values) else BLUE for value in values]
        bars.bar(names, values, color=colors)
        for place, value in enumerate(values):
            bars.text(place, value + 0.02, f"{value:.2f}", ha="center")
        bars.set(ylim=(0, 1.12), ylabel="relative manipulability")
        bars.set_title("Position in the plane, after each lock")
        return settle_layout(figure)


def draw_pose_sets() -> Figure:
    """Draw the tool positions of a weighted list, of a box with a density, and of a sampling function."""
    arm = hf.arms.load("pa10-9dof")
    rng = np.random.default_rng(0)
    job = arm.forward_kinematics(PA10_Q + rng.normal(0, 0.15, (200, arm.n)))
    weights = np.where(np.arange(200) < 20, 9.0, 1.0)
    low = hf.Region.box([0.968, 0, 0.041], 0.5, [0, 3.0369, 0], 1.5708, weight={"z": [(-0.21, 3), (0.29, 1)]})
    samples = low.samples(0, 600, 0, seed=1, sampling="random", count=600)
    density, spots = low.weights(samples), low.poses(samples)[:, :3, 3]
    direction = rng.normal(size=(400, 3))
    direction[:, 2] = np.abs(direction[:, 2])
    sphere = np.array([0.9, 0, -0.2]) + 0.3 * direction / np.linalg.norm(direction, axis=1)[:, None]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.3))
        axes = figure.subplots(1, 3, sharex=True, sharey=True)
        axes[0].scatter(*job[:, [0, 2], 3].T, s=3 * weights, color=BLUE, linewidth=0, alpha=0.7)
        axes[0].set_title("List with weights")
        axes[1].scatter(*spots[:, [0, 2]].T, s=4 * density, color=GREEN, linewidth=0, alpha=0.7)
        axes[1].set_title("Box with a density")
        axes[2].scatter(*sphere[:, [0, 2]].T, s=5, color=SKY, linewidth=0)
        axes[2].plot(0.9, -0.2, "s", color=ORANGE, ms=7)
        axes[2].annotate("part", (0.9, -0.2), (8, -4), textcoords="offset points", color=ORANGE)
        axes[2].set_title("Sampling function")
        for part in axes:
            part.set(aspect="equal", xlabel="x, m")
        axes[0].set_ylabel("z, m")
        return settle_layout(figure)
