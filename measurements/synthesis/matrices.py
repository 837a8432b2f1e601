"""Read matrices from text files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.files.reading import guard_reading, read_text


def read_matrix(path: str | Path) -> NDArray[np.float64]:
    """Read the matrix of a text file with one row per line and numbers separated by commas, semicolons, or spaces; ``#`` begins
    a comment.

    Raises:
        InputError: The file cannot be read, a word is not a number, or the rows differ in length; the message names the line.
    """
    name = Path(path).name
    with guard_reading(name):
        try:
            content = read_text(path)
        except UnicodeDecodeError as error:
            raise InputError(f"{name} is not a text file in UTF-8; write one row of the matrix per line") from error
    rows = list[list[float]]()
    for number, line in enumerate(content.split("\n"), 1):
        words = line.partition("#")[0].replace(",", " ").replace(";", " ").split()
        if not words:
            continue
        try:
            rows.append([float(word) for word in words])
        except ValueError as error:
            raise InputError(f"{name}, line {number}: '{line.strip()[:40]}' is not a row of numbers") from error
        if len(rows[-1]) != len(rows[0]):
            raise InputError(f"{name}, line {number}: {len(rows[-1])} numbers; the first row has {len(rows[0])}")
    if not rows:
        raise InputError(f"{name} has no numbers; write one row of the matrix per line")
    return np.array(rows)
