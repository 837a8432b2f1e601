"""Maps over the targets of a workspace."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from holdfast.present.convergence.places import measure_maps

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from holdfast.convergence.targets import TargetMeasures


def figures(t: TargetMeasures) -> dict[str, Figure]:
    """See :meth:`holdfast.TargetMeasures.figures`."""
    about = (
        f"{t.law.arm.name}, {t.law.name}: each place is a target, its value the mean over {len(t.starts)} starts; "
        "grey: no value"
    )
    count = int(t.ends.sum())
    return measure_maps(t.law, t.targets, t.measures, about, f"{count} failures" if count else "")


def save_maps(t: TargetMeasures, folder: Path) -> list[Path]:
    """Write each map as ``targets-NAME.png``."""
    from holdfast.report.figures import save_png

    return [save_png(figure, folder / f"targets-{name}.png", 130) for name, figure in t.figures().items()]
