"""Figure of the measured fault responses, read from the tables that the measurements write."""

from __future__ import annotations

import re
from pathlib import Path

from concepts import WIDTH_IN
from matplotlib.figure import Figure

from holdfast.interface.report import BLUE, INK, ORANGE, SKY, SOFT, settle_layout, style

TABLES = Path(__file__).parents[2] / "measurements" / "faults"
FEASIBLE_COLUMN = 2
RESPONSES = {  # by column of the table
    5: ("stop at an alarm", SOFT),
    3: ("no monitor", ORANGE),
    4: ("no monitor, no null-space objective", "#e8a36b"),
    6: ("monitor, without recover", SKY),
    7: ("monitor and recover", BLUE),
}


def draw_finished_tasks() -> Figure:
    """Draw the fraction of finished tasks after one fault for each response, with intervals, for two arms."""
    with style():
        figure = Figure(figsize=(WIDTH_IN, 2.9))
        for axes, (arm, title) in zip(
            figure.subplots(1, 2, sharey=True), (("panda", "Panda"), ("iiwa14", "iiwa 14")), strict=True
        ):
            table = read_row(TABLES / f"CHAIN-{arm}.md")
            for row, (column, (_, color)) in enumerate(RESPONSES.items()):
                value, low, high = table[column]
                axes.barh(row, value, height=0.6, color=color)
                axes.plot([low, high], [row, row], color=INK, lw=1.4)
            feasible = table[FEASIBLE_COLUMN][0]
            axes.axvline(feasible, color=INK, lw=0.9, linestyle=(0, (4, 2)), label="target within reach of the faulty arm")
            axes.set(xlim=(0, 100), xlabel="finished tasks, % (line: 95 % interval)", yticks=range(len(RESPONSES)))
            axes.set_yticklabels([label for label, _ in RESPONSES.values()])
            axes.set_title(f"{title}, one fault in each task")
        figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center")
        return settle_layout(figure)


def read_row(file: Path) -> dict[int, tuple[float, float, float]]:
    """Read the value and the interval of each column from the first row, which contains all faults."""
    lines = file.read_text(encoding="utf-8").splitlines()
    cells = next(line for line in lines if line.startswith("| all |")).strip("|").split("|")
    table = {}
    for column, cell in enumerate(cells):
        if found := re.fullmatch(r"([\d.]+) \(([\d.]+) to ([\d.]+)\)", cell.strip()):
            value, low, high = map(float, found.groups())
            table[column] = (value, low, high)
    return table
