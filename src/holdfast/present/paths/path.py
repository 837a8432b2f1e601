"""A path of the end effector, with its timing or without, as a notebook shows it."""

from __future__ import annotations

import numpy as np

from holdfast.paths.path import Path
from holdfast.paths.timed_path import TimedPath
from holdfast.present.printing import Rows, number


def sentences(path: Path | TimedPath) -> list[str]:
    """Its name, and what it is."""
    return [(path.path if isinstance(path, TimedPath) else path).name, path.describe()]


def key_table(path: Path | TimedPath) -> Rows:
    """Where the legs begin and end."""
    geometry = path.path if isinstance(path, TimedPath) else path
    ends = geometry.pose(geometry.bounds)[:, :3, 3]
    rows = [[f"{s:.3g}", *map(number, np.round(at, 9))] for s, at in zip(geometry.bounds, ends, strict=True)]
    return Rows(["fraction of the way", "x, m", "y, m", "z, m"], rows)


def next_steps(path: Path | TimedPath, name: str) -> list[str]:
    """The timing; of a path that has one the pose at a time."""
    if isinstance(path, TimedPath):
        return [f"{name}.pose({path.duration / 2:.4g})  # in the middle", f"{name}.slowed(2)  # the same in twice the time"]
    return [f"hf.paths.TimedPath({name}, hf.paths.Trapezoid(8))  # in 8 s; hf.follow takes that"]
