"""Figs. 4 to 12, made again."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

import holdfast as hf
from holdfast.interface.report import BLUE, FAINT, INK, ORANGE, SOFT, WIDTH_IN, save_png, settle_layout, style
from holdfast.kinematics.solvers import self_motion
from papers.english1998.hardware import DURATION as HARDWARE_DURATION
from papers.english1998.hardware import SCALES, Hardware
from papers.english1998.planar import DURATION, Extremes, Global, Planar, pose

Array = NDArray[np.float64]

DASHED = (0, (4.5, 2))
DOTTED = (0, (1.2, 1.6))


def draw_arm(axes: Axes, places: Array, color: str = INK, width: float = 2.0, size: float = 4.5) -> None:
    """A chain of links: places (K, 2) of the joints, the last one the end effector."""
    axes.plot(*places.T, "-", color=color, linewidth=width, solid_capstyle="round", zorder=3)
    axes.plot(*places[:-1].T, "o", color=color, markersize=size, markerfacecolor="white", zorder=4)
    axes.plot(*places[-1], "s", color=color, markersize=size, zorder=4)


def figure_4(planar: Planar, found: Extremes, path: Path) -> None:
    """Worst and best configuration of a point."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.78, 4.4))
        for axes, name, q, value in zip(
            figure.subplots(1, 2), ("worst", "best"), (found.worst, found.best), reversed(found.values), strict=True
        ):
            draw_arm(axes, planar.joints(q))
            share = planar.torque.by_joint(q) / planar.largest
            places = planar.joints(q)
            for k, place in enumerate(places[:-1]):
                crowded = k > 0 and (places[k - 1] > place).all()  # the link before comes from where the number would be
                at = (-40, -4) if crowded else (10, 8)
                axes.annotate(f"{share[k]:+.2f}", place, at, textcoords="offset points", color=BLUE)
            axes.set(
                title=f"{name}: cost {value:.4f}",
                xlabel="x, m",
                ylabel="y, m",
                aspect="equal",
                xlim=(-1.7, 1.7),
                ylim=(-2.3, 0.7),
            )
        _caption(
            figure,
            "Hand at (0.6, -1.9) m, gravity along -y. Beside each joint: its holding torque over the largest it can have. "
            "Best and worst of all configurations by optimisation, checked by tracing them all.",
        )
        save_png(settle_layout(figure), path, dpi=110)


def figure_5(planar: Planar, there: hf.Trajectory, back: hf.Trajectory, best: Global, path: Path) -> None:
    """The torque criterion along the line, both ways."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.78, 6.4))
        top, bottom = figure.subplots(2, 1, height_ratios=(1.15, 1))
        _arms_along(top, planar, there)
        x = there.poses[:, 0, 3]
        bottom.fill_between(x, there.value, color=BLUE, alpha=0.14, linewidth=0)
        bottom.plot(x, there.value, color=BLUE, label="right to left, local minimum followed")
        bottom.plot(back.poses[:, 0, 3], back.value, color=SOFT, linestyle=DASHED, label="left to right")
        bottom.plot(
            best.x, best.value, color=ORANGE, linestyle=DOTTED, linewidth=2, label="best of all configurations of each point"
        )
        _criterion(bottom, x, "normalised cost, 1 = largest of all")
        bottom.legend(loc="upper center")
        bottom.set_ylim(0, 0.55)
        _caption(
            figure,
            f"Torque criterion along y = {there.poses[0, 1, 3]:g} m (our assumption) in {DURATION:g} s, gradient projection, "
            f"{len(x)} samples; the best of all configurations at {len(best.x)} points.",
        )
        save_png(settle_layout(figure), path, dpi=110)


def figure_6(planar: Planar, motion: hf.Trajectory, borders: Sequence[float], path: Path, capped: bool = False) -> None:
    """Fig. 6, and with ``capped`` Fig. 8: the swing criterion and the joint-rate norm along the line."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.78, 8.0))
        top, middle, bottom = figure.subplots(3, 1, height_ratios=(1.25, 1, 1))
        _arms_along(top, planar, motion)
        x = motion.poses[:, 0, 3]
        middle.fill_between(x, motion.value, color=BLUE, alpha=0.14, linewidth=0)
        middle.plot(x, motion.value, color=BLUE)
        _criterion(middle, x, "(swing of joint 2 / pi)^2")
        bottom.plot(x, motion.rate_norm, color=BLUE, label="norm of the joint rates")
        if capped:
            bottom.axhline(1.0, color=ORANGE, linestyle=DASHED, linewidth=1.2, label="cap")
            bottom.set_ylim(0, 1.6)
        _criterion(bottom, x, "joint-rate norm, rad/s")
        for axes in (middle, bottom):
            for k, border in enumerate(borders):
                axes.axvline(border, color=INK, linestyle=DOTTED, label=None if k else "border of the region of zero cost")
        bottom.legend(loc="upper center")
        text = (
            f"Swing criterion of joint 2 along y = {motion.poses[0, 1, 3]:g} m (our assumption), right to left in "
            f"{DURATION:g} s, {len(x)} samples"
        )
        _caption(figure, text + (f"; cap of 1 rad/s, hand within {motion.position_error.max():.0e} m." if capped else "."))
        save_png(settle_layout(figure), path, dpi=110)


def figure_7(planar: Planar, motion: hf.Trajectory, border: float, path: Path) -> None:
    """The minimum that splits: the criterion over all configurations of four points of the motion."""
    places = (float(motion.poses[0, 0, 3]), (float(motion.poses[0, 0, 3]) + border) / 2, border, border - 0.15)
    y = float(motion.poses[0, 1, 3])
    texts = ("start of the line", "outside the region of zero cost", "at its border", "inside: the minimum has split")
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.78, 9.2))
        grid = figure.subplots(4, 2, width_ratios=(1, 2.2))
        for k, (x, text, (left, right)) in enumerate(zip(places, texts, grid, strict=True)):
            here = motion.q[int(np.argmin(np.abs(motion.poses[:, 0, 3] - x)))]
            draw_arm(left, planar.joints(here))
            left.set(aspect="equal", xlim=(-1.2, 2.4), ylim=(-1.6, 1.5), ylabel="y, m")
            first = _turned(here[0])
            for component in self_motion(planar.arm, pose(x, y), "planar", spacing=0.01).components:
                angle, value = _turned(component.q[:, 0]), planar.swing(component.q)
                angle = np.where(np.abs(np.diff(angle, append=angle[-1])) > 3, np.nan, angle)
                right.plot(angle, value, color=BLUE, linewidth=1.6)
            right.plot([first], [float(planar.swing(here))], "o", color=ORANGE, zorder=4)
            if k:
                right.set(xlim=(-0.5, 1.5), ylim=(-0.001, 0.02))
            right.set(ylabel="(swing of joint 2 / pi)^2", title=f"({'abcd'[k]}) x = {x:.3f} m: {text}")
        grid[-1, 0].set_xlabel("x, m")
        grid[-1, 1].set_xlabel("joint 1, rad from horizontal")
        _caption(
            figure,
            f"All configurations of four points on y = {y:g} m, traced 0.01 rad apart; dot and arm: where gradient projection "
            "is. (a) whole range, (b) to (d) a part.",
        )
        save_png(settle_layout(figure), path, dpi=110)


def figure_9_11(hardware: Hardware, motion: hf.Trajectory, text: str, path: Path) -> None:
    """The arm at three points of the path, from the side of its base axis and along the path."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.78, 4.3))
        axes = figure.subplots(1, 3, sharey=True)
        for ax, k in zip(axes, (0, len(motion.time) // 2, len(motion.time) - 1), strict=True):
            places = hardware.joints(motion.q[k])
            draw_arm(ax, places[:, [0, 2]])
            second = places[2]
            axis = 0.16 * hardware.arm.jacobian(motion.q[k])[3:, 1]
            ends = np.stack([second - axis, second + axis])
            ax.plot(ends[:, 0], ends[:, 2], color=ORANGE, linewidth=2.2, label="axis of joint 2" if k == 0 else None, zorder=5)
            ax.set(aspect="equal", xlabel="x, m", title=f"after {hardware.way[k]:.1f} m", xlim=(-0.15, 0.95), ylim=(-0.75, 0.6))
        axes[0].set_ylabel("z (up), m")
        axes[0].legend(loc="upper right")
        _caption(figure, f"{text} Seen along the path (y); joint 1 turns about x, gravity points down.")
        save_png(settle_layout(figure), path, dpi=110)


def figure_10(hardware: Hardware, path: Path) -> None:
    """Torque of joint 2 along the path, made small, for three times."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.78, 7.0))
        panels = figure.subplots(len(SCALES), 1, sharex=True, sharey=True)
        for ax, scale in zip(panels, SCALES, strict=True):
            ax.plot(hardware.way, hardware.torque(hardware.small, scale), color=BLUE, label="whole dynamics")
            ax.plot(hardware.way, hardware.gravity(hardware.small), color=ORANGE, linestyle=DASHED, label="gravity alone")
            ax.set(ylabel="torque of joint 2, N m", title=f"{scale * HARDWARE_DURATION:g} s")
        panels[-1].set_xlabel("distance along the path, m")
        panels[0].legend(loc="upper right", ncols=2)
        _caption(
            figure, "Static torque of joint 2, squared, made small: torque of the whole dynamics at three times for the path."
        )
        save_png(settle_layout(figure), path, dpi=110)


def figure_12(hardware: Hardware, path: Path) -> None:
    """Torque of joint 2 along the path, made large, beside what it is when made small."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.78, 3.8))
        axes = figure.subplots()
        axes.plot(
            hardware.way, np.abs(hardware.torque(hardware.large, 1.0)), color=BLUE, label=f"made large, {HARDWARE_DURATION:g} s"
        )
        for scale, line in ((1.0, "-"), (SCALES[-1], DASHED)):
            torque = np.abs(hardware.torque(hardware.small, scale))
            axes.plot(hardware.way, torque, color=ORANGE, linestyle=line, label=f"made small, {scale * HARDWARE_DURATION:g} s")
        axes.set(xlabel="distance along the path, m", ylabel="|torque of joint 2|, N m", ylim=(0, None))
        axes.legend(loc="center right")
        _caption(figure, "Static torque of joint 2, squared, made large, beside the motions of Fig. 10; whole dynamics.")
        save_png(settle_layout(figure), path, dpi=110)


def _arms_along(axes: Axes, planar: Planar, motion: hf.Trajectory, count: int = 13) -> None:
    few = np.linspace(0, len(motion.time) - 1, count).astype(int)
    for k in few:
        axes.plot(*planar.joints(motion.q[k]).T, "-", color=SOFT, linewidth=1.0)
    for k in (few[0], few[count // 2], few[-1]):
        draw_arm(axes, planar.joints(motion.q[k]))
    axes.plot(*motion.poses[:, :2, 3].T, color=FAINT, linewidth=5, zorder=0)
    axes.set(aspect="equal", ylabel="y, m", xlabel="x, m")


def _criterion(axes: Axes, x: Array, label: str) -> None:
    axes.set(xlabel="x of the end effector, m", ylabel=label, xlim=(float(x.min()), float(x.max())))
    axes.set_ylim(bottom=0)


def _caption(figure: Figure, text: str) -> None:
    import textwrap

    figure.supxlabel("\n".join(textwrap.wrap(text, 110)), fontsize=9, color=SOFT)


def _turned(angle: Array) -> Array:
    """In (-pi, pi]."""
    return np.asarray(np.arctan2(np.sin(angle), np.cos(angle)))
