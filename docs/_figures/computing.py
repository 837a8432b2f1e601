"""Figures of the guides on large runs, GPUs and learning frameworks."""

from __future__ import annotations

import numpy as np
from concepts import WIDTH_IN, draw_arm
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch
from scipy.stats import binomtest

import holdfast as hf
from holdfast.interface.report import BLUE, GREEN, INK, ORANGE, SKY, SOFT, settle_layout, style

CHUNK_ROWS = 8192
POSES = 20_000
COMBINATIONS = ("arm A, index 1", "arm A, index 2", "arm B, index 1", "arm B, index 2")
TOOL_DISTANCE_M = 1.6
STEP_RAD = 0.04


def draw_growing_run() -> Figure:
    """Draw the estimate of a run and its interval against the number of stored poses."""
    arm = hf.arms.load("planar-3r")
    region = hf.Region.around_tool(arm, hf.arms.about("planar-3r").home)
    run = hf.assess(arm, region, task="planar", poses=POSES, seed=7)
    is_kept = np.asarray(run.columns["index"]) >= 0.3
    counts = np.unique(np.geomspace(100, POSES, 60).astype(int))
    kept = np.cumsum(is_kept)[counts - 1]
    intervals = [binomtest(int(k), int(n)).proportion_ci(method="exact") for k, n in zip(kept, counts, strict=True)]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.1))
        axes = figure.subplots()
        low, high = [part.low for part in intervals], [part.high for part in intervals]
        axes.fill_between(counts, low, high, color=SKY, linewidth=0, label="95 % interval")
        axes.plot(counts, kept / counts, color=BLUE, label="estimate")
        for chunk in (CHUNK_ROWS, 2 * CHUNK_ROWS):
            axes.axvline(chunk, color=SOFT, lw=0.8)
        axes.axvline(CHUNK_ROWS, color=ORANGE, linestyle=(0, (4, 2)), label="stopped and resumed")
        axes.set(
            xlabel="stored poses",
            ylabel="fraction of poses\nwith an index of 0.3 or more",
        )
        axes.set(xlim=(0, POSES), ylim=(0.35, 0.6))
        axes.set_title("Chunks of 8,192 poses; the result is the same with and without the stop")
        axes.legend(loc="upper right", ncols=3)
        return settle_layout(figure)


def draw_backends() -> Figure:
    """Draw the way from an expression to the processor and to a GPU."""
    boxes = {
        "expression\n(CasADi)": (0.9, 1.0, SOFT),
        "LLVM": (3.0, 1.0, BLUE),
        "machine code": (5.1, 1.55, GREEN),
        "PTX": (5.1, 0.45, ORANGE),
        "several rows in each\nSIMD instruction": (8.0, 1.55, GREEN),
        "driver: one row\nin each GPU thread": (8.0, 0.45, ORANGE),
    }
    arrows = [((1.65, 1.0), (2.25, 1.0)), ((3.75, 1.1), (4.35, 1.45)), ((3.75, 0.9), (4.35, 0.55))]
    arrows += [((5.85, 1.55), (6.9, 1.55)), ((5.85, 0.45), (6.9, 0.45))]
    with style():
        figure = Figure(figsize=(WIDTH_IN, 2.1))
        axes = figure.subplots()
        for text, (x, y, color) in boxes.items():
            draw_box(axes, text, x, y, 2.2 if x > 6 else 1.5, color)
        for tail, head in arrows:
            axes.annotate("", head, tail, arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1})
        axes.text(5.1, 2.0, "backend llvm (default)", ha="center", color=GREEN)
        axes.text(5.1, 0.0, "backend cuda", ha="center", va="center", color=ORANGE)
        axes.set(xlim=(0, 9.3), ylim=(-0.15, 2.2))
        axes.set_axis_off()
        return settle_layout(figure)


def draw_gradient_steps() -> Figure:
    """Draw the index over the folds of a planar arm, and steps along its gradient."""
    arm = hf.arms.load("planar-3r")
    rho = hf.indices.relative_manipulability(arm, "planar")
    angles = np.radians(np.linspace(-175, 175, 141))
    second, third = np.meshgrid(angles, angles)
    q = np.column_stack([np.zeros(second.size), second.ravel(), third.ravel()])
    values = rho(q).reshape(second.shape)
    steps = [np.radians([0.0, 80.0, 10.0])]
    for _ in range(80):
        slope = rho.gradient(steps[-1])
        steps.append(steps[-1] + STEP_RAD * slope / max(1.0, float(np.linalg.norm(slope))))
    way = np.array(steps)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.8))
        plane, arms = figure.subplots(1, 2, width_ratios=[1.25, 1])
        drawn = plane.contourf(np.degrees(second), np.degrees(third), values, levels=12, cmap="Blues")
        figure.colorbar(drawn, ax=plane, label="worst-case relative manipulability")
        plane.plot(*np.degrees(way[:, 1:]).T, color=ORANGE, lw=1.8)
        plane.plot(*np.degrees(way[0, 1:]), "o", color="white", mec=ORANGE, ms=6)
        plane.plot(*np.degrees(way[-1, 1:]), "o", color=ORANGE, ms=6)
        plane.set(xlabel="joint 2, deg", ylabel="joint 3, deg", aspect="equal")
        plane.set_title("Gradient steps on the index")
        draw_arm(arms, arm, way[0], color=SKY)
        draw_arm(arms, arm, way[-1], color=BLUE)
        arms.set(xlim=(-0.8, 2.0), ylim=(-0.5, 2.3), aspect="equal", xlabel="x, m", ylabel="y, m")
        arms.set_title(f"Before ({float(rho(way[0])):.2f}) and after ({float(rho(way[-1])):.2f})")
        return settle_layout(figure)


def draw_study() -> Figure:
    """Draw how a study is cut into chunks that workers compute and one program stores."""
    workers = ((BLUE, "worker 1"), (GREEN, "worker 2"), (ORANGE, "worker 3"))
    rng = np.random.default_rng(3)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 2.5))
        axes = figure.subplots()
        for row, name in enumerate(COMBINATIONS):
            axes.text(-0.15, -row, name, ha="right", va="center")
            for chunk in range(4):
                color = SOFT if row == 3 and chunk > 1 else workers[int(rng.integers(3))][0]
                corner = (chunk * 0.75, -row - 0.3)
                axes.add_patch(FancyBboxPatch(corner, 0.6, 0.6, boxstyle="round,pad=0.03", fc=color, ec="none"))
                if color == SOFT:
                    axes.text(chunk * 0.75 + 0.3, -row, "missing", ha="center", va="center", color="white", fontsize=7.5)
        for place, (color, name) in enumerate(workers):
            draw_box(axes, name, 4.9, -0.5 - place, 1.2, color)
        draw_box(axes, "the program\nthat you started\nwrites the folder", 7.6, -1.5, 1.9, INK, height=1.5)
        axes.annotate("", (6.55, -1.5), (5.7, -1.5), arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1})
        axes.text(1.4, 0.62, "chunks", ha="center")
        axes.text(-0.15, 0.62, "combinations", ha="right")
        axes.set(xlim=(-1.9, 8.7), ylim=(-3.6, 0.95))
        axes.set_axis_off()
        return settle_layout(figure)


def draw_box(axes: Axes, text: str, x: float, y: float, width: float, color: str, height: float = 0.62) -> None:
    """Draw a rounded box with a text; its centre is (x, y)."""
    corner = (x - width / 2, y - height / 2)
    axes.add_patch(FancyBboxPatch(corner, width, height, boxstyle="round,pad=0.04", fc="white", ec=color, lw=1.4))
    axes.text(x, y, text, ha="center", va="center", fontsize=9)
