"""Options of the commands that evaluate many positions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Literal

from holdfast.interface.cli.declaration import FigurePath

FolderOption = Annotated[FigurePath, "Folder for report, figures, table and summary."]
MeasureTimeOption = Annotated[float | None, "Time limit of each motion in s.", "2000/gain s"]
PlacesOption = Annotated[Literal["starts", "targets"], "Positions of the map: starts or targets."]
MapTimeOption = Annotated[float | None, "Time limit of each motion in s.", "500/gain s"]


@dataclass(frozen=True)
class MeasureOptions:
    """Options for the samples and the method of convergence measures."""

    out: FolderOption = None
    starts: Annotated[
        str | None,
        "Start positions: grid:52 (a lattice of 52 x 52 over the workspace of a planar arm), or a number of random ones.",
        "grid:52 in a plane, else 100; over targets 20",
    ] = None
    configurations: Annotated[
        int | None,
        "Number of configurations per start, on each curve of its self-motion or at random.",
        "36 in a plane, else 8; over targets 8 and 4",
    ] = None
    points: Annotated[
        int | None, "Number of failures per joint and motion; 0 skips F100 to Fsens.", "10 in a plane, else 3; over targets 2"
    ] = None
    method: Annotated[
        Literal["brute", "procedure", "sampled"] | None,
        "Failures: brute (all), procedure (only where a wrong end point attracts the arm), or sampled (random configurations).",
        "brute in a plane, else sampled",
    ] = None
    relative_to: Annotated[
        Literal["inside", "whole"],
        "Reference of F100 to Fsens: inside (the path within the joints' ranges) or whole (the whole path).",
    ] = "inside"

    def library_arguments(self) -> dict[str, Any]:
        """Return the options as arguments of the library."""
        return {name: getattr(self, name) for name in ("configurations", "points", "method", "relative_to")}


@dataclass(frozen=True)
class MapOptions:
    """Options for the positions and motions of a convergence map."""

    out: FolderOption = None
    starts: Annotated[str, "Start positions: a number of random ones, or a lattice such as grid:52."] = "1000"
    configurations: Annotated[int, "Number of motions per position."] = 20
    over: PlacesOption = "starts"
