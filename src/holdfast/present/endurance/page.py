"""Pictures and page of what a motion survives."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from holdfast.files.output import put
from holdfast.present import results
from holdfast.report.figures import save_png
from holdfast.report.motions import Panel, motion_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.endurance.endurance import Endurance


def figures(e: Endurance) -> dict[str, Figure]:
    """Survival over time."""
    level = None if e.guaranteed else (100 * e.survival, "mean")
    panel = Panel(e.time, 100 * e.curve(), "locks survived, %", "If a joint locks at this time", level)
    return {"survival": motion_figure([panel], f"{e.arm.name}, {e.path.describe()}", "time, s")}


def save(e: Endurance, folder: Path, command: str = "") -> list[Path]:
    """endurance.json, motion.csv, survival.png and report.html."""
    (file,) = put(folder, {"endurance.json": json.dumps(e.to_dict(), indent=2) + "\n"})
    drawn = figures(e)
    pictures = [save_png(figure, folder / f"{name}.png", 150) for name, figure in drawn.items()]
    return [file, e.to_csv(folder / "motion.csv"), *pictures, results.write(e, folder / "report.html", command, drawn)]
