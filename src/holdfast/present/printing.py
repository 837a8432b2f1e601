"""What every command prints with: tables and lines for people, JSON for machines."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import typer

if TYPE_CHECKING:
    from rich.console import Console


class Rows(NamedTuple):
    """A table as the console and the page show it: texts, and what is above them."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    title: str = ""


def plain(value: Any) -> Any:
    """JSON types of NumPy ones; infinity and NaN become null, which JSON has, complex numbers their two parts."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, complex):
        return {"real": plain(value.real), "imaginary": plain(value.imag)}
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def print_json(data: Any) -> None:
    """One JSON document on stdout, of types that JSON has: :func:`plain` makes them."""
    typer.echo(json.dumps(data, indent=2, allow_nan=False))


def number(value: float | np.floating[Any], digits: int = 4) -> str:
    """A value for a table; rounding noise about 0 is 0."""
    value = float(value)
    if not math.isfinite(value):
        return "infinite" if math.isinf(value) else "none"
    return "0" if abs(value) < 1e-12 else f"{value:.{digits}g}"


def alike(values: Iterable[float], units: str | Sequence[str] = "", digits: int = 4) -> list[str]:
    """A column of values: those of one unit with one precision, unless they are of sizes that have none."""
    x = np.array([float(v) for v in values])
    unit = np.array([units] * x.size if isinstance(units, str) else units)
    found = [number(v, digits) for v in x]
    for one in dict.fromkeys(unit.tolist()):
        sizes = np.abs(x[mine := (unit == one)])
        sizes = sizes[np.isfinite(sizes) & (sizes > 1e-12)]
        if not sizes.size or sizes.max() > 1e5 * sizes.min() or sizes.min() < 1e-6:
            continue
        decimals = max(digits - 1 - math.floor(math.log10(sizes.max())), 1 - math.floor(math.log10(sizes.min())), 0)
        for k in np.flatnonzero(mine & np.isfinite(x)):
            found[k] = f"{x[k] + 0.0:.{decimals}f}" if abs(x[k]) > 1e-12 else f"{0:.{decimals}f}"
    return [f"{text} {u}" if u and u != "1" else text for text, u in zip(found, unit, strict=True)]


def print_rows(out: Console, table: Rows) -> None:
    """The rows below their title."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    if table.title:
        out.print(escape(f"{table.title}:"), soft_wrap=True)
    shown = Grid(*map(escape, table.head))
    for row in table.rows:
        shown.add_row(*map(escape, row))
    out.print(shown)


def print_written(out: Console, files: Iterable[Path | None]) -> None:
    """Say which files were written."""
    from rich.markup import escape

    for file in files:
        if file is not None:
            out.print(f"written: {escape(str(file))}", soft_wrap=True)


def print_each(
    of: Any, configurations: Sequence[Any], as_json: bool, data: Callable[..., Any], show: Callable[..., None]
) -> None:
    """What ``of`` is worth at each configuration: one JSON document, a list where there are several, or tables for people."""
    if as_json:
        found = [plain(data(of, q)) for q in configurations]
        print_json(found if len(found) > 1 else found[0])
        return
    out = console()
    for q in configurations:
        show(of, q, out)


def console(stderr: bool = False) -> Console:
    """Where tables for people go; wide when no terminal says how wide it is."""
    from holdfast.present.terminal import Screen

    return Screen(stderr)
