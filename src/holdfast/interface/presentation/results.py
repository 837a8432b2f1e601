"""Output of commands: a result as JSON or text, its files, and the command line for its report."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from holdfast.core.result import Result
from holdfast.interface import report
from holdfast.interface.presentation import call_presenter
from holdfast.interface.presentation.printing import make_console, print_json, print_written_files


def print_result(
    result: Result, as_json: bool, files: Sequence[Path | None] = (), listed: bool = False, **options: Any
) -> None:
    """Print a result as JSON or as text, and the names of the written files.

    With ``listed``, the JSON document also contains the files. The options are parameters of ``to_dict`` and ``show`` of the
    result, for example thresholds.
    """
    if as_json:
        print_json(result.to_dict(**options) | ({"files": list(map(str, files))} if listed else {}))
        return
    out = make_console()
    call_presenter(result, "show", out, **options)
    print_written_files(out, files)


def print_results(results: Sequence[Result], as_json: bool) -> None:
    """Print several results as text, or as one JSON document, which is a list if there are several results."""
    if as_json:
        data = [result.to_dict() for result in results]
        print_json(data if len(data) > 1 else data[0])
        return
    for result in results:
        print_result(result, False)


def current_command() -> str:
    """Return the current command line, as the report prints it."""
    return f"holdfast {shlex.join(sys.argv[1:])}"


def write_outputs(result: Result, plot: Path | None, out: Path | None = None, **options: Any) -> list[Path]:
    """Write the first figure of the result as the PNG file ``plot``, and its report into the folder ``out``, if given.

    The options are parameters of the presentation.
    """
    files = []
    if plot is not None:
        files.append(report.save_png(result.plot(**options), plot))
    return files if out is None else [*files, *result.save(out, command=current_command(), **options)]
