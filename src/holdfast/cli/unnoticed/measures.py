"""Options of the commands that look at many places."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

FolderOption = Annotated[Path | None, "Folder for report, figures, table and summary."]
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
        help="Configurations per start: on each curve of its self-motion, or random ones.",
        show_default="36, or 8; over targets 8, or 4",
    ),
]
PointsOption = Annotated[
    int | None,
    typer.Option(
        "--points",
        help="Failures of each joint on each motion; 0 for the ranges only.",
        show_default="10, or 3; over targets 2",
    ),
]
MethodOption = Annotated[
    Literal["brute", "procedure", "sampled"] | None,
    typer.Option(
        "--method",
        help="Simulate all failures, only those where a sink exists, or all failures of random configurations.",
        show_default="brute in a plane, else sampled",
    ),
]
RelativeOption = Annotated[
    Literal["inside", "whole"], "F as a fraction of the part of the path within the joints' ranges, or of the whole path."
]
MeasureTimeOption = Annotated[float | None, typer.Option("--time-limit", help="Time limit, s.", show_default="2000/gain s")]
MapStartsOption = Annotated[str, "A number of random places, or a lattice as grid:52."]
MapConfigurationsOption = Annotated[int, "Motions for each place."]
MapTimeOption = Annotated[float | None, typer.Option("--time-limit", help="Time limit, s.", show_default="500/gain s")]
OverOption = Annotated[Literal["starts", "targets"], "What the places of the map are: starts or targets."]
