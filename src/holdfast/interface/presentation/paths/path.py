"""Notebook view of a path of the end effector, with or without timing."""

from __future__ import annotations

import numpy as np

from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.kinematics.paths.path import Path
from holdfast.kinematics.paths.timed_path import TimedPath


def sentences(path: Path | TimedPath) -> list[str]:
    """Return the name and the description of the path."""
    return [(path.path if isinstance(path, TimedPath) else path).name, path.describe()]


def key_table(path: Path | TimedPath) -> TextTable:
    """Tabulate the positions at which the legs begin and end."""
    geometry = path.path if isinstance(path, TimedPath) else path
    positions = geometry.pose(geometry.bounds)[:, :3, 3]
    rows = [
        [f"{fraction:.3g}", *map(format_significant, np.round(position, 9))]
        for fraction, position in zip(geometry.bounds, positions, strict=True)
    ]
    return TextTable(["fraction of the way", "x, m", "y, m", "z, m"], rows)
