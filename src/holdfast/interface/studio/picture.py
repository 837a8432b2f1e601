"""Drawing of a view: the arm from the side and from above, with its failures marked."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.view import choose_views
from holdfast.interface.report.figures import (
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    SOFT,
    WIDTH_IN,
    format_label,
    settle_layout,
    style,
    svg,
)
from holdfast.interface.report.motions import draw_chain, show_view
from holdfast.interface.studio.machine import CompiledArm
from holdfast.interface.studio.state import State


def draw_view_svg(machine: CompiledArm, state: State, ghosts: Sequence[FloatArray] = ()) -> str:
    """Draw a view as SVG text.

    Args:
        machine: Compiled arm.
        state: State with the configuration and the failed joints.
        ghosts: Configurations (n,) of further arms in the drawing, green and orange.
    """
    from matplotlib.figure import Figure

    chains = machine.arm.frames(np.array([*ghosts, state.q]))[..., :3, 3]
    views = choose_views(machine.arm, chains)
    with style():
        figure = Figure(figsize=(WIDTH_IN, WIDTH_IN / len(views) * 0.95 if len(views) > 1 else 0.7 * WIDTH_IN))
        for position, view in enumerate(views, 1):
            axes = figure.add_subplot(1, len(views), position)
            for chain, color in zip(chains[:-1], (GREEN, ORANGE, PURPLE), strict=False):
                axes.plot(*view.project(chain).T, color=color, linewidth=3, alpha=0.55, solid_capstyle="round")
            _draw_arm(axes, view.project(chains[-1]), state)
            show_view(axes, view)
        figure.suptitle(format_label(_format_caption(state)), x=0.01, ha="left", fontsize=9.5)
        settle_layout(figure)
    return svg(figure, "studio", _format_caption(state))


def _draw_arm(axes: Axes, chain: FloatArray, state: State) -> None:
    draw_chain(axes, chain, node_size=0.0, tool_color=SOFT, solid_capstyle="round")
    for joint, (point, condition) in enumerate(zip(chain[1:-1], state.conditions, strict=True)):
        color, marker = {"healthy": ("white", "o"), "locked": (ORANGE, "X"), "free": (PURPLE, "P")}[condition]
        size = 6 if condition == "healthy" else 11
        axes.plot(*point, marker=marker, color=color, markeredgecolor=INK, markersize=size, zorder=3.2 + 0.1 * (size > 6))
        if condition != "healthy":
            axes.annotate(
                format_label(f"{state.names[joint]} {condition}"),
                tuple(point),
                (8, 6),
                textcoords="offset points",
                color=INK,
                zorder=4,
            )


def _format_caption(state: State) -> str:
    failed = ", ".join(f"{state.names[k]} {state.conditions[k]}" for k in state.failed_joints)
    return f"{state.arm}: {failed or 'all joints healthy'}"
