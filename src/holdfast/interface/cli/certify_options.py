"""Options of the commands of ``holdfast certify``, and their conversion to the arguments of a claim."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.core.errors import InputError
from holdfast.interface.cli.declaration import FigurePath
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import FailuresOption, JsonOption, PlotOption, SeedOption
from holdfast.interface.cli.values import read_numbers, read_numbers_by_joint
from holdfast.model.failure_modes.sets import read_failures

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm

    Ranges = dict[str | int, tuple[float, float]]

REJECTED_EXIT_CODE = 1
REFUTED_EXIT_CODE = 4

LimitOption = Annotated[list[str] | None, "Working range JOINT=LOW..HIGH in rad or m. Repeatable. Default: the joint limits."]
AnglesOption = Annotated[bool, "Read joint values in degrees (prismatic joints: m)."]
HalvingsOption = Annotated[int, "Largest number of bisections of each axis of the target box."]
JointHalvingsOption = Annotated[int, "Largest number of bisections of each joint interval."]
CheckOption = Annotated[bool, typer.Option("--check/--no-check", help="Verify the certificate (needs holdfast-arms[certify]).")]
CertificateOption = Annotated[Path, "File for the certificate."]


@dataclass(frozen=True)
class TargetBoxOptions:
    """Options for a box of targets."""

    box: Annotated[str, "Center of the target box in m: x,y,z; in a plane x,y."]
    size: Annotated[str, "Edge lengths of the target box in m: one number, or one per axis."]
    rotation: Annotated[
        str | None,
        "Orientation at every target: roll,pitch,yaw in degrees, Rz(yaw) Ry(pitch) Rx(roll); in a plane yaw. Default: any.",
    ] = None
    rotation_size: Annotated[str | None, "Edge lengths around --rotation in degrees: one number or three. Default: 0."] = None
    pointing: Annotated[bool, "Prescribe only the direction of the tool's z axis in --rotation."] = False

    def claim_arguments(self) -> dict[str, Any]:
        """Return the targets as arguments of a claim."""
        from holdfast.model.arm.formats.urdf import rpy_rotation

        box = {
            "centre": read_numbers("--box", self.box, "two or three numbers, m,"),
            "size": read_numbers("--size", self.size, "one number, or one for each axis, m,"),
        }
        if self.rotation is None:
            if self.rotation_size is not None or self.pointing:
                raise InputError("--rotation-size and --pointing need --rotation, which is missing; give it as well")
            return box
        angles = read_numbers("--rotation", self.rotation, "roll, pitch and yaw")
        edges = read_numbers("--rotation-size", self.rotation_size or "0", "one number, or three,")
        if angles.size not in (1, 3) or edges.size not in (1, angles.size) or not (edges >= 0).all():
            raise InputError(
                "--rotation takes roll,pitch,yaw, or yaw in a plane; --rotation-size one number, or one each, from 0"
            )
        radians_per_degree, arguments = np.pi / 180, box | ({"task": "pointing"} if self.pointing else {})
        if angles.size == 3 and not edges.any():
            return arguments | {"rotation": rpy_rotation((radians_per_degree * angles).tolist())}
        intervals = radians_per_degree * np.column_stack([angles - edges / 2, angles + edges / 2])
        return arguments | {"rpy": intervals if angles.size == 3 else intervals[0]}


@dataclass(frozen=True)
class LockedTargetBoxOptions(TargetBoxOptions):
    """Options for a box of targets and a locked joint."""

    lock: Annotated[str | None, "Locked joint with its possible values: JOINT=LOW..HIGH in rad or m. Default: none."] = None
    limit: LimitOption = None
    degrees: AnglesOption = False

    def read_claim_arguments(self, arm: Arm) -> dict[str, Any]:
        """Return targets, lock and limits as arguments of a claim."""
        locked = None if self.lock is None else read_joint_intervals(arm, "--lock", [self.lock], self.degrees)
        limits = read_joint_intervals(arm, "--limit", self.limit, self.degrees)
        return self.claim_arguments() | {"locked": locked, "limits": limits}


@dataclass(frozen=True)
class JointBoxOptions:
    """Options for a box of configurations, around a center or within limits."""

    around: Annotated[str | None, "Center of the configuration box in rad, one value per joint. Default: the limits."] = None
    within: Annotated[str | None, "Half widths of the configuration box in rad: one number, or one per joint."] = None
    limit: LimitOption = None
    degrees: AnglesOption = False

    def read_box(self, arm: Arm) -> Ranges:
        """Return the ranges of the joints that the options name."""
        box: Ranges = {}
        if (self.around is None) != (self.within is None):
            raise InputError("--around and --within go together; give the center of the box and its half widths")
        if self.around is not None and self.within is not None:
            center = read_numbers("--around", self.around, f"{arm.n} numbers,")
            half_widths = read_numbers("--within", self.within, f"one number, or {arm.n},")
            if len(center) != arm.n or len(half_widths) not in (1, arm.n):
                raise InputError(
                    f"--around and --within have {len(center)} and {len(half_widths)} numbers; give {arm.n}, and one or {arm.n}"
                )
            if (half_widths < 0).any():
                raise InputError(f"--within is {half_widths.min():g}; a half width must be 0 or larger")
            pairs = zip(arm.joint_names, center, [*half_widths] * (arm.n // len(half_widths)), strict=True)
            texts = [f"{name}={value - half_width}..{value + half_width}" for name, value, half_width in pairs]
            box = read_joint_intervals(arm, "--around", texts, self.degrees)
        return box | read_joint_intervals(arm, "--limit", self.limit, self.degrees)


@dataclass(frozen=True)
class ConfigurationBoxOptions(JointBoxOptions):
    """Options for a box of configurations, and for the task and failures in it."""

    task: Annotated[str, "Task: pose, or planar-pose for an arm that moves in a plane."] = "pose"
    failures: FailuresOption = "single"

    def read_claim_arguments(self, arm: Arm) -> dict[str, Any]:
        """Return the box, failures and task as arguments of a claim."""
        return {"joint_box": self.read_box(arm), "failures": read_failures(arm, self.failures), "task": self.task}


@dataclass(frozen=True)
class SearchOptions:
    """Options for the resources of the search, and for the folder from which it resumes."""

    time_limit: Annotated[
        float | None, "Time limit in s, half of it for the check. Parameter boxes still open then are undecided. Default: none."
    ] = None
    workers: Annotated[int, "Number of worker processes; does not change the certificate."] = 1
    store: Annotated[Path | None, "Folder for the search, from which the same command resumes. Default: none."] = None
    check: CheckOption = True


@dataclass(frozen=True)
class CertificateOutput:
    """Options for the output files of a certificate and its display."""

    out: CertificateOption = Path()
    plot: PlotOption = None
    report: Annotated[FigurePath, "HTML file for a report of the proof. Default: not written."] = None
    json_: JsonOption = False


@dataclass(frozen=True)
class SeedOptions:
    """Option for the seed."""

    seed: SeedOption = 0


@dataclass(frozen=True)
class UnseededProofOptions(CertificateOutput, ArmSourceOptions, SearchOptions):
    """Options of all commands that prove a claim; the options of the last base class come first in the help."""


@dataclass(frozen=True)
class ProofOptions(CertificateOutput, SeedOptions, ArmSourceOptions, SearchOptions):
    """Options of commands that prove a claim by a randomised search."""


def read_joint_intervals(arm: Arm, option: str, texts: list[str] | None, degrees: bool) -> Ranges:
    """Read ``JOINT=LOW..HIGH`` as a range in rad or m by joint."""
    ends: tuple[list[str], list[str]] = [], []
    for text in texts or []:
        joint, _, span = text.rpartition("=")
        lower, separator, upper = span.partition("..")
        if not (separator and lower and upper):
            raise InputError(
                f"{option} '{text}' is not an interval; write JOINT=LOW..HIGH, such as {arm.joint_names[0]}=-0.5..0.5"
            )
        for end, value in zip(ends, (lower, upper), strict=True):
            end.append(f"{joint}={value}")
    lower_ends, upper_ends = (read_numbers_by_joint(arm, end, option, degrees) for end in ends)
    return {name: (lower_ends[name], upper_ends[name]) for name in lower_ends}
