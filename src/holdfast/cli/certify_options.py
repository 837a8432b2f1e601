"""Options of the commands of ``holdfast certify``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

REJECTED, REFUTED = 1, 4  # exit codes

CertificateOption = Annotated[Path, typer.Option("--out", help="Certificate to write.")]
BoxOption = Annotated[
    str, typer.Option("--box", help="Centre of the targets, m: x, y, z; x, y in a plane.", show_default=False)
]
SizeOption = Annotated[
    str, typer.Option("--size", help="Edges of the box, m: one number, or one for each axis.", show_default=False)
]
LockOption = Annotated[
    str | None,
    typer.Option("--lock", help="JOINT=LOW..HIGH, rad or m: where it may be locked. Default: healthy.", show_default=False),
]
LimitOption = Annotated[
    list[str] | None,
    typer.Option("--limit", help="JOINT=LOW..HIGH, rad or m: a working range. May be given again.", show_default=False),
]
RotationOption = Annotated[
    str | None,
    typer.Option(
        "--rotation",
        help="Roll, pitch and yaw of the tool at every target, rad: Rz(yaw) Ry(pitch) Rx(roll); in a plane yaw. Default: any.",
        show_default=False,
    ),
]
TurnsOption = Annotated[
    str | None,
    typer.Option(
        "--rotation-size",
        help="Edges of a box around --rotation, rad: one number, or three. Default: none.",
        show_default=False,
    ),
]
PointingOption = Annotated[
    bool, typer.Option("--pointing", help="Of --rotation only where the tool's z axis points counts, not its turn about it.")
]
AroundOption = Annotated[
    str | None,
    typer.Option("--around", help="Middle of the box: a value of each joint, rad. Default: limits.", show_default=False),
]
WithinOption = Annotated[
    str | None,
    typer.Option("--within", help="Half widths of it, rad: one number, or one for each joint.", show_default=False),
]
RowsOption = Annotated[str, typer.Option("--task", help="pose; planar-pose for arms in a plane.")]
JointHalvingsOption = Annotated[int, typer.Option("--halvings", help="Of each joint, at most.")]
AnglesOption = Annotated[bool, typer.Option("--degrees", help="Angles are in degrees (slides stay in m).")]
HalvingsOption = Annotated[int, typer.Option("--halvings", help="Of each axis of the box, at most.")]
TimeOption = Annotated[
    float | None, typer.Option("--time-limit", help="s after which the rest is undecided.", show_default=False)
]
CheckOption = Annotated[bool, typer.Option("--check/--no-check", help="Verify what was found (needs holdfast[certify]).")]
ReportOption = Annotated[
    Path | None, typer.Option("--report", help="Write a page of what is proved into this HTML file.", show_default=False)
]
WorkersOption = Annotated[int, typer.Option("--workers", help="Processes; the certificate is the same.")]
StoreOption = Annotated[
    Path | None,
    typer.Option(
        "--store",
        help="Folder that remembers what is done, so that the same command resumes a search that was stopped or killed.",
        show_default=False,
    ),
]
