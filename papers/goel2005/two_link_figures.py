"""Figs. 1 to 4, made again."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from holdfast.interface.report import (
    BLUE,
    FAINT,
    INK,
    ORANGE,
    SKY,
    SOFT,
    WIDTH_IN,
    legend_below,
    save_png,
    settle_layout,
    style,
)
from papers.goel2005 import drawing
from papers.goel2005.drawing import point
from papers.goel2005.two_link_motion import START, Ended, hand, rate, target, wrapped

GREEN = "#007a5e"


def figure_1(stuck: Ended, path: Path) -> None:
    """The geometry of rest: command and column of the locked joint are parallel."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.5, 5.0))
        axes = figure.subplots()
        q, x = stuck.run.q_final, stuck.run.target
        at = hand(q[1])
        drawing.arm(axes, q, 0)
        axes.plot([0, at[0]], [0, at[1]], color=SOFT, linestyle=drawing.DASHED)
        axes.annotate("x$_a$", point(at / 2), (4, -12), textcoords="offset points", color=SOFT)
        column = np.array([-at[1], at[0]])
        command = x - at
        for vector, text, color, shift, width in (
            (column, "column j$_1$", GREEN, (-66, -14), 4.5),
            (command, "command", BLUE, (10, 2), 1.8),
        ):
            line = {"arrowstyle": "-|>", "color": color, "linewidth": width, "shrinkA": 0, "shrinkB": 0}
            axes.annotate("", point(at + vector), point(at), arrowprops=line, zorder=5)
            axes.annotate(text, point(at + 0.5 * vector), shift, textcoords="offset points", color=color)
        drawing.target(axes, x, "target C")
        drawing.plane(axes, 2.4, "Fig. 1: at rest, and yet commanded")
        across = command[0] * column[1] - command[1] * column[0]
        angle = abs(np.degrees(np.arcsin(across / np.linalg.norm(command) / np.linalg.norm(column))))
        drawing.caption(
            figure,
            f"Case C at rest: joint 2 at {wrapped(stuck.angle):.3f} deg. Command and column of the locked joint 1 (dot) are "
            f"parallel to within {angle:.0e} deg, so only joint 1 is commanded.",
            62,
        )
        save_png(settle_layout(figure), path, dpi=110)


def figure_2(found: Sequence[Ended], path: Path) -> None:
    """The four targets."""
    with style():
        figure = Figure(figsize=(WIDTH_IN * 0.5, 5.0))
        axes = figure.subplots()
        axes.add_patch(Circle((0, 0), 2, facecolor="#eef1f4", edgecolor=SOFT, linewidth=0.8, zorder=0))
        axes.add_patch(Circle((1, 0), 1, fill=False, edgecolor=BLUE, linewidth=1.5, zorder=1))
        drawing.arm(axes, START, 0)
        axes.annotate("x(t$_0$)", point(hand(START[1])), (6, -12), textcoords="offset points")
        for f in found:
            drawing.target(axes, f.run.target, f.case.name)
        drawing.plane(axes, 3.1, "Fig. 2: what a lock of joint 1 leaves")
        drawing.caption(
            figure,
            "Grey: workspace of the healthy arm. Circle: what it is with joint 1 (dot) locked at 0. The same start for the "
            "four "
            "targets.",
            62,
        )
        save_png(settle_layout(figure), path, dpi=110)


def figure_3_4(rho: float, found: Sequence[Ended], path: Path) -> None:
    """Joint 2 over the direction of the target: where the error grows, which way the joint turns, where it rests."""
    phi, angle = np.meshgrid(np.linspace(-180, 180, 721), np.linspace(-180, 180, 721))
    with style(), np.errstate(divide="ignore", invalid="ignore"):
        speed = rate(np.deg2rad(angle), target(rho, phi))
        growth = np.sin(np.deg2rad(angle - phi)) * speed
        figure = Figure(figsize=(WIDTH_IN * 0.72, 7.4))
        axes = figure.subplots()
        axes.contourf(phi, angle, np.where(growth > 0, 1.0, -1.0), [-2, 0, 2], colors=[SKY, "#f3f4f6"])
        _arrows(axes, rho)
        _lines(axes, rho)
        for f, color in zip(found, (BLUE, "#a8497f"), strict=True):
            _motion(axes, f, color)
        axes.set(xlabel="direction of the target from joint 2, phi, deg", ylabel="angle of joint 2, theta2, deg")
        axes.set(xlim=(-180, 180), ylim=(-180, 180), xticks=range(-180, 181, 45), yticks=range(-180, 181, 45))
        axes.set_title(f"Fig. {2 + rho:.0f}: targets {rho:g} m from joint 2")
        axes.fill_between([], [], color=SKY, label="error shrinks")
        axes.fill_between([], [], color="#f3f4f6", edgecolor=FAINT, label="error grows")
        legend_below(figure, axes, 3)
        save_png(settle_layout(figure), path, dpi=110)


def _arrows(axes: Axes, rho: float) -> None:
    """Which way joint 2 turns."""
    phi, angle = np.meshgrid(np.arange(-165, 180, 30.0), np.arange(-165, 180, 30.0))
    way = np.sign(rate(np.deg2rad(angle), target(rho, phi)))
    axes.quiver(phi, angle, 0 * way, way, color=SOFT, scale=26, width=0.0035, headwidth=5, headlength=5, pivot="mid", zorder=3)


def _lines(axes: Axes, rho: float) -> None:
    phi = np.linspace(-179.99, 179.99, 3001)
    x = target(rho, phi)
    rest = np.rad2deg(2 * np.arctan2((2 - x[:, 0]) * np.sign(x[:, 1]), np.abs(x[:, 1])))
    for k, turned in enumerate((rest - 360, rest, rest + 360)):
        axes.plot(
            phi, _broken(turned), color=INK, linewidth=2.6, label="joint 2 stands (stable or not)" if k == 0 else None, zorder=4
        )
    if rho == 1:
        axes.axvline(0, color=INK, linewidth=2.6, zorder=4)
    else:
        edge = np.rad2deg(np.arccos(1 / rho))
        axes.plot([-edge, edge], [0, 0], color=INK, linewidth=2.6, zorder=4)
        for side, name in ((-edge, "S1"), (edge, "S2")):
            axes.plot(side, 0, "o", color="white", markeredgecolor=INK, markersize=6, zorder=6)
            axes.annotate(name, (side, 0), (-18 if side < 0 else 8, 6), textcoords="offset points", zorder=6)
    axes.plot(phi, phi, color=GREEN, linestyle=drawing.DASHED, linewidth=1.8, label="least error", zorder=5)
    for k, turned in enumerate((phi - 180, phi + 180)):
        label = None if k else "greatest error"
        axes.plot(phi, turned, color=ORANGE, linestyle=drawing.DOTTED, linewidth=2.0, label=label, zorder=5)


def _broken(degrees: np.ndarray) -> np.ndarray:
    return np.where(np.abs(np.diff(degrees, append=degrees[-1])) > 90, np.nan, degrees)


def _motion(axes: Axes, f: Ended, color: str) -> None:
    """The way of joint 2, a vertical line."""
    degrees = np.rad2deg(f.path.q[:, 1])
    turned = wrapped(degrees)
    phi = f.case.phi
    axes.plot(np.full(len(turned), phi), _broken(turned), color=color, linewidth=2.4, zorder=7)
    axes.plot(phi, turned[0], "s", color=color, markersize=7, zorder=8)
    axes.annotate(f.case.name, (phi, turned[0]), (7, 8), textcoords="offset points", color=color, weight="bold", zorder=8)
    if f.run.outcome != "moving":
        axes.plot(phi, turned[-1], "o", color="white", markeredgecolor=color, markeredgewidth=2.2, markersize=8, zorder=8)
