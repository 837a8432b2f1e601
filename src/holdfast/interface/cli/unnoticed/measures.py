"""Options of the commands that evaluate many positions."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

FolderOption = Annotated[Path | None, "Folder for report, figures, table and summary."]
MeasureTimeOption = Annotated[float | None, "Time limit, s.", "2000/gain s"]
PlacesOption = Annotated[Literal["starts", "targets"], "What the places of the map are: starts or targets."]
MapTimeOption = Annotated[float | None, "Time limit, s.", "500/gain s"]


@dataclass(frozen=True)
class MeasureOptions:
    """Options for the samples and the method of convergence measures."""

    out: FolderOption = None
    starts: Annotated[
        str | None,
        "grid:52, a lattice over the workspace of a planar arm, or a number of random places.",
        "grid:52, or 100; over targets 20",
    ] = None
    configurations: Annotated[
        int | None,
        "Configurations per start: on each curve of its self-motion, or random ones.",
        "36, or 8; over targets 8, or 4",
    ] = None
    points: Annotated[
        int | None, "Failures of each joint on each motion; 0 for the ranges only.", "10, or 3; over targets 2"
    ] = None
    method: Annotated[
        Literal["brute", "procedure", "sampled"] | None,
        "Simulate all failures, only those where a sink exists, or all failures of random configurations.",
        "brute in a plane, else sampled",
    ] = None
    relative_to: Annotated[
        Literal["inside", "whole"], "F as a fraction of the part of the path within the joints' ranges, or of the whole path."
    ] = "inside"

    def library_arguments(self) -> dict[str, Any]:
        """Return the options as arguments of the library."""
        return {name: getattr(self, name) for name in ("configurations", "points", "method", "relative_to")}


@dataclass(frozen=True)
class MapOptions:
    """Options for the positions and motions of a convergence map."""

    out: FolderOption = None
    starts: Annotated[str, "A number of random places, or a lattice as grid:52."] = "1000"
    configurations: Annotated[int, "Motions for each place."] = 20
    over: PlacesOption = "starts"
