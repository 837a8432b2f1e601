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


def next_steps(path: Path | TimedPath, name: str) -> list[str]:
    """Suggest a timing for the path; for a timed path the pose at a time."""
    if isinstance(path, TimedPath):
        return [f"{name}.pose({path.duration / 2:.4g})  # in the middle", f"{name}.stretch(2)  # the same in twice the time"]
    return [f"hf.paths.TimedPath({name}, hf.paths.Trapezoid(8))  # in 8 s; hf.follow takes that"]
