"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from holdfast.core.labels import FAILURES_HELP, TASK_SIZES

NOT_MET_EXIT_CODE = 3  # exit code: it worked, and the answer is that not everything asked for is met

ArmArgument = Annotated[str, typer.Argument(metavar="ARM", help="Built-in name, URDF or MJCF file, or DH table (YAML).")]
FailureOption = Annotated[Path | None, "What is locked, has lost range or is slow (YAML file), for --lock."]
JsonOption = Annotated[bool, "Print JSON for machines."]
TASK_HELP = f"{', '.join(TASK_SIZES)}, or rows such as vx,vy,wz or tool:vz. Default: the arm's own."
TaskOption = Annotated[str | None, TASK_HELP]
TARGET_HELP = (
    "Where the tool should go, m: as many numbers as the task has rows; with turns x,y,z,roll,pitch,yaw (m and degrees, "
    "as URDF) or x,y,z and a quaternion x,y,z,w."
)
LengthOption = Annotated[float, "Characteristic length, m, that divides linear rows."]
QOption = Annotated[list[str], "Joint values, rad and m, separated by commas or spaces. May be given again."]
DegreesOption = Annotated[bool, "--q is in degrees (prismatic joints stay in m)."]
StartDegreesOption = Annotated[bool, "--start is in degrees (prismatic joints stay in m)."]
PathArgument = Annotated[Path, typer.Argument(metavar="PATH", help="Path file (YAML): line, arc or poses.")]
PathTaskOption = Annotated[
    str | None,
    f"{', '.join(TASK_SIZES)}, or rows such as vx,vy,wz. Default: position for a path of positions (planar if the arm "
    "moves in a plane), else pose.",
]
KeepOption = Annotated[
    list[str] | None,
    "upright:10deg, rail:0,0,1 or plane:0,0,1 (rad and m, or with deg, mm behind): kept along the whole motion. "
    "May be given again.",
]
DurationOption = Annotated[float | None, "Duration, s. Default: the file's."]
MotionCsvOption = Annotated[Path | None, "Write the motion to this file."]
PlotOption = Annotated[Path | None, "Draw into this PNG file."]
OutOption = Annotated[Path | None, "Folder for report.html and figures."]
SeedOption = Annotated[int, "Seed of all random draws."]
FailuresOption = Annotated[str, f"{FAILURES_HELP} or '2; 1+4'."]
