"""Results over places as files: a table with one row for each place, and a summary."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from holdfast.control.convergence.places import Places
from holdfast.core.files.csv_table import write_rows
from holdfast.core.files.output import make_folder, replace_file


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
    output_folder = make_folder(folder)
    files = [output_folder / f"{name}.csv", output_folder / f"{name}.json"]
    rows = np.column_stack([places.points, *values])
    texts = (["" if np.isnan(value) else f"{value:.9g}" for value in row] for row in rows)
    write_rows(files[0], ["x_m", "y_m", "z_m", *columns], texts)
    replace_file(files[1], json.dumps(summary, indent=2) + "\n")
    return files
