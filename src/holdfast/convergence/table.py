"""Results over places as files: a table with a line for each place, and a summary."""

from __future__ import annotations

import csv
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.convergence.places import Places
from holdfast.files.output import made, replaced, writing


def save_places(
    folder: str | Path,
    name: str,
    places: Places,
    columns: Sequence[str],
    values: Sequence[ArrayLike],
    summary: Mapping[str, Any],
) -> list[Path]:
    """Write ``name.csv``, places and ``columns`` from values (P,) or (P, C), empty where NaN; and ``name.json``.

    Raises:
        StoreError: The folder cannot be written.
    """
    place = made(folder)
    files = [place / f"{name}.csv", place / f"{name}.json"]
    with writing(files[0]) as stream:
        writer = csv.writer(stream)
        writer.writerow(["x_m", "y_m", "z_m", *columns])
        for row in np.column_stack([places.points, *values]):
            writer.writerow(["" if np.isnan(x) else f"{x:.9g}" for x in row])
    replaced(files[1], json.dumps(summary, indent=2) + "\n")
    return files
