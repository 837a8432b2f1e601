"""Figure of the state machines of the controller, from its table of transitions."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from holdfast.interface.report import BLUE, INK, SOFT, settle_layout, style
from holdfast.response.supervisor import TRANSITION_TABLE

WIDTH_IN = 8.6
PLACES = {
    "FollowingLaw": (0.0, 0.0), "Waiting": (0.0, 1.0), "OnRoute": (0.0, 2.0),
    "Watching": (1.0, 0.0), "Alarmed": (1.0, 1.0), "Braked": (1.0, 2.0), "Stopped": (1.0, 3.0),
    "NoTrial": (2.0, 0.0), "OnTrial": (2.0, 1.0),
}  # fmt: skip
INITIAL = {"FollowingLaw", "Watching", "NoTrial"}
COLUMNS = ("motion", "supervision", "trial")


def draw_machines() -> Figure:
    """Draw every state and every transition between two different states."""
    pairs = list(dict.fromkeys((row.source, row.target) for row in TRANSITION_TABLE if row.source != row.target))
    with style():
        figure = Figure(figsize=(WIDTH_IN, 4.6))
        axes = figure.subplots()
        for source, target in pairs:
            draw_transition(axes, source, target)
        for state, (column, row) in PLACES.items():
            color = BLUE if state in INITIAL else "white"
            axes.text(
                column, -row, state, ha="center", va="center", color="white" if state in INITIAL else INK,
                bbox={"boxstyle": "round,pad=0.45", "fc": color, "ec": BLUE if state in INITIAL else SOFT},
            )  # fmt: skip
        for column, name in enumerate(COLUMNS):
            axes.text(column, 0.6, name, ha="center", weight="bold", color=INK)
        axes.set(xlim=(-0.55, 2.45), ylim=(-3.4, 0.8))
        axes.set_axis_off()
        return settle_layout(figure)


def draw_transition(axes: Axes, source: str, target: str) -> None:
    """Draw an arrow that bends aside, more so over a longer distance."""
    (column, begin), (_, end) = PLACES[source], PLACES[target]
    distance = round(abs(end - begin))
    bend = (-0.15, -0.55, -0.5)[distance - 1]
    side = (0.08, 0.13, 0.13)[distance - 1] * (1 if end > begin else -1)
    axes.annotate(
        "", (column + side, -end), (column + side, -begin),
        arrowprops={"arrowstyle": "-|>", "color": SOFT, "lw": 1.2, "shrinkA": 13, "shrinkB": 13,
                    "connectionstyle": f"arc3,rad={bend}"},
    )  # fmt: skip
