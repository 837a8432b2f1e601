"""Output of all commands: tables and lines for people, JSON for machines."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import typer

from holdfast.core.formatting import format_number

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.core.typing import FloatArray

_ROUNDING_ERROR = 2e-9  # a number below it beside larger ones is 0


class TextTable(NamedTuple):
    """Table of texts with column headers and a title, for the console and the page."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    title: str = ""


def to_json_types(value: Any) -> Any:
    """Convert NumPy types to JSON types; infinity and NaN become null, complex numbers become their two parts."""
    if isinstance(value, dict):
        return {str(key): to_json_types(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [to_json_types(item) for item in value]
    if isinstance(value, np.ndarray):
        return to_json_types(value.tolist())
    if isinstance(value, np.generic):
        return to_json_types(value.item())
    if isinstance(value, complex):
        return {"real": to_json_types(value.real), "imaginary": to_json_types(value.imag)}
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def print_json(data: Any) -> None:
    """Print one JSON document on stdout; the data have JSON types only (:func:`to_json_types` converts them)."""
    typer.echo(json.dumps(data, indent=2, allow_nan=False))


def format_column(values: Iterable[float], units: str | Sequence[str] = "", digits: int = 4) -> list[str]:
    """Format a column of values: values of one unit share one precision, unless their magnitudes differ too much."""
    numbers = np.array([float(value) for value in values])
    units_by_row = np.array([units] * numbers.size if isinstance(units, str) else units)
    texts = [format_number(value, digits) for value in numbers]
    for unit_name in dict.fromkeys(units_by_row.tolist()):
        magnitudes = np.abs(numbers[has_unit := (units_by_row == unit_name)])
        magnitudes = magnitudes[np.isfinite(magnitudes) & (magnitudes > _ROUNDING_ERROR)]
        if not magnitudes.size or magnitudes.max() > 1e5 * magnitudes.min() or magnitudes.min() < 1e-6:
            continue
        decimals = max(digits - 1 - math.floor(math.log10(magnitudes.max())), 1 - math.floor(math.log10(magnitudes.min())), 0)
        for row in np.flatnonzero(has_unit & np.isfinite(numbers)):
            texts[row] = f"{numbers[row] + 0.0:.{decimals}f}" if abs(numbers[row]) > _ROUNDING_ERROR else f"{0:.{decimals}f}"
    return [
        f"{text} {unit_text}" if unit_text and unit_text != "1" else text
        for text, unit_text in zip(texts, units_by_row, strict=True)
    ]


def format_position(value: float, unit: str, digits: int = 4) -> str:
    """Format a joint position, an angle, or another measure with its unit; an angle in rad is also given in degrees."""
    text = f"{format_number(value, digits)} {unit}" if unit not in ("", "1") else format_number(value, digits)
    return f"{text} ({format_number(np.degrees(value), digits)} deg)" if unit == "rad" else text


def format_positions(values: Sequence[float] | FloatArray, units: Sequence[str], digits: int = 5) -> list[str]:
    """Format a column of positions, or of measures of joints; angles are also given in degrees."""
    degrees = iter(
        format_column(np.degrees([value for value, unit in zip(values, units, strict=True) if unit == "rad"]), "deg")
    )
    pairs = zip(format_column(values, units, digits), units, strict=True)
    return [f"{text} ({next(degrees)})" if unit == "rad" else text for text, unit in pairs]


def print_table(out: Console, table: TextTable) -> None:
    """Print the title and the rows of a table."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    if table.title:
        out.print(escape(f"{table.title}:"), soft_wrap=True)
    grid = BandedTable(*map(escape, table.head))
    for row in table.rows:
        grid.add_row(*map(escape, row))
    out.print(grid)


def print_written_files(out: Console, files: Iterable[Path | None]) -> None:
    """Print the names of the files that were written."""
    from rich.markup import escape

    for file in files:
        if file is not None:
            out.print(f"written: {escape(str(file))}", soft_wrap=True)


def print_evaluations(
    measure: Any, configurations: Sequence[Any], as_json: bool, data: Callable[..., Any], show: Callable[..., None]
) -> None:
    """Print the values of a measure at each configuration: one JSON document (a list where there are several) or tables."""
    if as_json:
        documents = [to_json_types(data(measure, q)) for q in configurations]
        print_json(documents if len(documents) > 1 else documents[0])
        return
    out = make_console()
    for q in configurations:
        show(measure, q, out)


def make_console(stderr: bool = False) -> Console:
    """Return the console for tables; it is wide when the width of the terminal is unknown."""
    from holdfast.interface.presentation.terminal import WrappingConsole

    return WrappingConsole(stderr)
