"""Options of the commands that look at many places."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from holdfast.cli.laws import read_places
from holdfast.errors import InputError

FolderOption = Annotated[
    Path | None, typer.Option("--out", help="Folder for report, figures, table and summary.", show_default=False)
]
StartsOption = Annotated[
    str | None,
    typer.Option(
        "--starts",
        help="grid:52, a lattice over the workspace of a planar arm, or a number of random places.",
        show_default="grid:52, or 100; over targets 20",
    ),
]
ConfigurationsOption = Annotated[
    int | None,
    typer.Option(
        "--configurations",
        help="Of each start: on each curve of its self-motion, or random ones.",
        show_default="36, or 8; over targets 8, or 4",
    ),
]
PointsOption = Annotated[
    int | None,
    typer.Option(
        "--points", help="Failures of each joint on each motion; 0: ranges only.", show_default="10, or 3; over targets 2"
    ),
]
ProcedureOption = Annotated[
    bool, typer.Option("--procedure/--brute", help="Simulate only failures where there is a sink, or all.")
]
SampledOption = Annotated[
    bool,
    typer.Option(
        "--sampled", help="Random configurations of each start; so it is for every arm that does not move in a plane."
    ),
]
WholeOption = Annotated[
    bool, typer.Option("--whole/--inside", help="F of the whole way, or of its part within the joints' ranges.")
]
MeasureTimeOption = Annotated[float | None, typer.Option("--time-limit", help="s.", show_default="2000/gain s")]
MapStartsOption = Annotated[str, typer.Option("--starts", help="A number of random places, or a lattice as grid:52.")]
MapConfigurationsOption = Annotated[int, typer.Option("--configurations", help="Motions for each place.")]
MapTimeOption = Annotated[float | None, typer.Option("--time-limit", help="s.", show_default="500/gain s")]
OverOption = Annotated[Literal["starts", "targets"], typer.Option("--over", help="What the places of the map are.")]


def measured(starts: str | None, procedure: bool, sampled: bool, whole: bool, **more: Any) -> dict[str, Any]:
    """What --starts, --procedure, --sampled and --whole are to the library, and ``more``."""
    if procedure and sampled:
        raise InputError("--procedure and --sampled exclude each other; leave one out")
    return {
        "starts": None if starts is None else read_places(starts),
        "method": "procedure" if procedure else "sampled" if sampled else None,
        "relative_to": "whole" if whole else "inside",
        **more,
    }
