"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from holdfast.core.extras import import_extra
from holdfast.core.labels import FAILURES_HELP, TASK_SIZES
from holdfast.interface.cli.declaration import FigurePath

NOT_MET_EXIT_CODE = 3  # exit code: the command worked, and a requirement of the user is not met


def _require_rerun(path: Path | None) -> Path | None:
    """Raise before any work is done if a recording is requested and rerun-sdk is not installed."""
    if path is not None:
        import_extra("rerun", "rerun", "rerun-sdk")
    return path


ARM_HELP = "Arm: built-in name, URDF, xacro, or MJCF file, DH table (YAML), or name of robot_descriptions."
ArmArgument = Annotated[
    str,
    typer.Argument(metavar="ARM", help=ARM_HELP),
]
ArmOption = Annotated[str, ARM_HELP]
FailureOption = Annotated[Path | None, "Failure file (YAML) with locked, range-limited or slowed joints; replaces --lock."]
JsonOption = Annotated[bool, "Print the result as JSON."]
TASK_NAMES_HELP = f"Task: {', '.join(TASK_SIZES)}, or components such as vx,vy,wz (world axes) or tool:vz (tool axes)."
TASK_HELP = f"{TASK_NAMES_HELP} Default: the task of a built-in arm, planar for an arm that moves in a plane, else pose."
TaskOption = Annotated[str | None, TASK_HELP]
TARGET_HELP = (
    "Target of the tool in the world frame: one number in m per task component, or, for a task with orientation, "
    "x,y,z,roll,pitch,yaw (m and degrees, URDF convention) or x,y,z (m) and a quaternion x,y,z,w."
)
LengthOption = Annotated[float, "Characteristic length in m, by which the linear components of the task are divided."]
QOption = Annotated[list[str], "Joint values in rad and m, separated by commas or spaces. Repeatable."]
AT_HELP = "Current joint values in rad and m, separated by commas or spaces."
AtDegreesOption = Annotated[bool, "Read --at in degrees (prismatic joints: m)."]
DegreesOption = Annotated[bool, "Read --q in degrees (prismatic joints: m)."]
FreeOption = Annotated[
    str | None,
    "Joints that lose their torque, by name or number, or board:NAME of --friction, comma-separated. Default: all.",
]
StartDegreesOption = Annotated[bool, "Read --start in degrees (prismatic joints: m)."]
KeepOption = Annotated[
    list[str] | None,
    "Constraint along the whole motion: upright:10deg (tool z axis within 10 deg of straight down), rail:0,0,1 (tool moves "
    "along this axis) or plane:0,0,1 (tool point stays in the plane with this normal). Default units: rad, m. Repeatable.",
]
MotionCsvOption = Annotated[Path | None, "CSV file for the motion."]
RrdOption = Annotated[
    Path | None, _require_rerun, "Recording of the motion (.rrd) for the Rerun viewer (needs the extra 'rerun')."
]
PlotOption = Annotated[FigurePath, "PNG file for the figure."]
OutOption = Annotated[FigurePath, "Folder for report.html and figures."]
PageOption = Annotated[Path | None, "Folder for report.html."]
RegionOption = Annotated[Path | None, "Region file (YAML). Default: a box around the first arm's home, 1/4 of its reach wide."]
ThreadsOption = Annotated[int | None, "Number of threads. Default: all processors."]
SeedOption = Annotated[int, "Seed of all random numbers."]
FailuresOption = Annotated[str, f"Failures that may occur: {FAILURES_HELP} or, by number from 1, '2; 1+4'."]
