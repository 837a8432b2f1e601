"""Notebook view of a path of the end effector, with or without timing."""

from __future__ import annotations

import numpy as np

from holdfast.interface.presentation.presentation import Header, Presentation, TableSpec, make_headers
from holdfast.kinematics.paths.path import Path
from holdfast.kinematics.paths.timed_path import TimedPath


def present(path: Path | TimedPath) -> Presentation:
    """Present the path with the positions at which its segments begin and end."""
    geometry = path.path if isinstance(path, TimedPath) else path
    positions = np.round(geometry.pose(geometry.bounds)[:, :3, 3], 9)
    fraction_column = Header("fraction of the path", digits=3, aligned=False)
    columns = [fraction_column, *make_headers("x, m", "y, m", "z, m", aligned=False)]
    rows = [(fraction, *position) for fraction, position in zip(geometry.bounds, positions, strict=True)]
    return Presentation(geometry.name, geometry.name, lines=[path.describe()], tables=[TableSpec("", columns, rows)])
