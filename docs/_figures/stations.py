"""Figure of the computers of an experiment and of the connections between them."""

from __future__ import annotations

from computing import draw_box
from matplotlib.figure import Figure

from holdfast.interface.report import BLUE, GREEN, INK, ORANGE, SOFT, settle_layout, style

BOX_COLORS = {"station": BLUE, "proxy": ORANGE, "server": GREEN}


def draw_network() -> Figure:
    """Draw stations and the experimenter's browser, which reach the server through a proxy with TLS."""
    with style():
        figure = Figure(figsize=(8.6, 2.7))
        axes = figure.subplots()
        for row, (text, link) in enumerate([("station 1", "token"), ("station 2", "token"), ("experimenter's page", "key")]):
            draw_box(axes, text, 0.8, 2.0 - row, 1.6, BOX_COLORS["station"])
            axes.annotate("", (3.95, 1.0), (1.65, 2.0 - row), arrowprops={"arrowstyle": "<->", "color": SOFT})
            axes.text(1.78, 2.14 - 0.98 * row, link, fontsize=8.5, color=INK)
        axes.text(4.8, 1.5, "HTTPS and WebSockets", ha="center", fontsize=9, color=ORANGE)
        draw_box(axes, "proxy (TLS)\nCaddy or nginx", 4.8, 1.0, 1.6, BOX_COLORS["proxy"])
        axes.annotate("", (6.45, 1.0), (5.65, 1.0), arrowprops={"arrowstyle": "<->", "color": SOFT})
        axes.text(6.05, 1.2, "local", ha="center", fontsize=9, color=INK)
        draw_box(axes, "holdfast teleop\nserve", 7.3, 1.0, 1.6, BOX_COLORS["server"])
        axes.annotate("", (7.3, 0.2), (7.3, 0.62), arrowprops={"arrowstyle": "->", "color": SOFT})
        axes.text(7.3, 0.02, "folder of records", ha="center", fontsize=9, color=INK)
        axes.set(xlim=(-0.15, 8.3), ylim=(-0.55, 2.6))
        axes.set_axis_off()
        return settle_layout(figure)
