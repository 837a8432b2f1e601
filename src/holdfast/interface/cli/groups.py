"""Groups of options that several commands share, each declared and read in one place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from holdfast.core.errors import InputError
from holdfast.core.formatting import format_count
from holdfast.interface.cli.options import (
    TASK_NAMES_HELP,
    FailuresOption,
    JsonOption,
    LengthOption,
    OutOption,
    PlotOption,
    TaskOption,
)
from holdfast.interface.cli.values import check_path_units, read_numbers, read_task
from holdfast.interface.presentation.results import print_result, write_outputs
from holdfast.model.arms.spec import ArmSpec, arm_specs_from_options, parse_held_joints, parse_xacro_arguments

if TYPE_CHECKING:
    from holdfast.core.result import Result
    from holdfast.kinematics.paths import TimedPath
    from holdfast.model.arm.friction import Friction
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task
    from holdfast.model.collision.clearance import Clearance

ArmsArgument = Annotated[
    list[str],
    typer.Argument(
        metavar="ARM",
        help="Arms: built-in names, URDF, xacro, or MJCF files, DH tables (YAML), or names of robot_descriptions.",
    ),
]
GroupOption = Annotated[str | None, "Group of the SRDF file that gives base and tip (URDF)."]
XacroOption = Annotated[list[str] | None, "Argument of a xacro file: NAME=VALUE. Repeatable."]
PackagesOption = Annotated[Path | None, "Folder with the ROS packages that a URDF or xacro file names."]
_PER_ARM = "Once for all arms, or once per arm in order ('-' for none)."


@dataclass(frozen=True)
class ArmSourceOptions:
    """Options that select the kinematic chain of an arm file."""

    base: Annotated[str | None, "Base link or body (URDF, MJCF). Default: the root."] = None
    tip: Annotated[str | None, "Tip link, body or site (URDF, MJCF). Default: the only end that is not a finger."] = None
    hold: Annotated[
        list[str] | None, "Joint to fix, such as a gripper's (URDF, MJCF): JOINT=VALUE in rad or m. Repeatable."
    ] = None

    group: GroupOption = None
    xacro: XacroOption = None
    packages: PackagesOption = None

    def resolve_arm(self, spec: str) -> Arm:
        """Return the arm that ``spec`` and these options describe."""
        hold = parse_held_joints(",".join(self.hold)) if self.hold else {}
        xacro = parse_xacro_arguments(self.xacro)
        return ArmSpec(spec, self.base, self.tip, hold, group=self.group, xacro=xacro, packages=self.packages).load()


@dataclass(frozen=True)
class ArmSourcesOptions:
    """Options that select the kinematic chains of several arms, and their names."""

    base: Annotated[list[str] | None, f"Base link or body (URDF, MJCF). {_PER_ARM} Default: the root."] = None
    tip: Annotated[list[str] | None, f"Tip link, body or site. {_PER_ARM} Default: the only end that is not a finger."] = None
    hold: Annotated[list[str] | None, f"Joints to fix (URDF, MJCF): JOINT=VALUE in rad or m, commas between. {_PER_ARM}"] = None
    name: Annotated[list[str] | None, "Name of an arm in the results, once per arm in order ('-': its own)."] = None
    group: Annotated[list[str] | None, f"Group of the SRDF file that gives base and tip. {_PER_ARM}"] = None
    xacro: XacroOption = None
    packages: PackagesOption = None

    def resolve_arms(self, specs: Sequence[str]) -> list[ArmSpec]:
        """Return the arms that ``specs`` and these options describe; see
        :func:`holdfast.model.arms.spec.arm_specs_from_options` for the errors.
        """
        xacro = parse_xacro_arguments(self.xacro)
        return arm_specs_from_options(
            specs, self.base, self.tip, self.hold, self.name, self.group, xacro=xacro, packages=self.packages
        )


@dataclass(frozen=True)
class OutputOptions:
    """Options for the display of a result."""

    plot: PlotOption = None
    out: OutOption = None
    json_: JsonOption = False

    def print_result(self, result: Result, files: Sequence[Path] = ()) -> None:
        """Print the result and the paths of ``files``, the requested picture, and the requested folder."""
        print_result(result, self.json_, [*files, *write_outputs(result, self.plot, self.out)])


@dataclass(frozen=True)
class TaskOptions:
    """Options for the task and the failures for which an index is computed."""

    task: TaskOption = None
    failures: FailuresOption = "single"
    length: LengthOption = 1.0


@dataclass(frozen=True)
class PathOptions:
    """Options for a tool path, with its task and duration."""

    path: Annotated[Path, typer.Argument(metavar="PATH", help="Path file (YAML): line, arc or poses.")]
    task: Annotated[
        str | None,
        f"{TASK_NAMES_HELP} Default: pose; for a path of positions, position (planar for an arm that moves in a plane).",
    ] = None
    duration: Annotated[float | None, "Duration of the path in s. Default: that of the path file."] = None

    def load_path(self, spec: str, arm: Arm) -> tuple[TimedPath, str | Task]:
        """Load the path, and return it with the task of the arm that ``spec`` names."""
        from holdfast.kinematics.paths import TimedPath
        from holdfast.model.arm.task import default_path_task

        timed = TimedPath.load(self.path, self.duration)
        check_path_units(arm, timed.path, f"path '{self.path}'")
        return timed, read_task(self.task or default_path_task(arm, timed.path.oriented), spec, arm)


_MOUNT_ROTATIONS = {
    "floor": np.eye(3),
    "wall": np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    "ceiling": np.diag([1.0, -1, -1]),
}


@dataclass(frozen=True)
class MountingOptions:
    """Options for the mounting, the gravity, and the payload of an arm."""

    mount: Annotated[
        str, "Mounting: floor (as in the file), wall (rotated by 90 deg about y) or ceiling (180 deg about x)."
    ] = "floor"
    gravity: Annotated[str | None, "Gravity in the world frame in m/s^2, for example 0,0,-9.81. Default: that of the arm."] = (
        None
    )
    payload: Annotated[
        str | None,
        "Point mass: kg, optionally followed by its position x,y,z in m in the frame of the last link (default 0,0,0).",
    ] = None

    def mount_arm(self, arm: Arm) -> Arm:
        """Return the arm with this mounting, gravity, and payload.

        Raises:
            InputError: An unknown mounting, or a wrong count of numbers.
        """
        from holdfast.model.arm.machine import Link

        if self.mount not in _MOUNT_ROTATIONS:
            raise InputError(f"--mount '{self.mount}' is not known; use one of {', '.join(_MOUNT_ROTATIONS)}")
        mount_pose = np.eye(4)
        mount_pose[:3, :3] = _MOUNT_ROTATIONS[self.mount]
        arm = arm.with_base(mount_pose @ arm.base)
        if self.gravity is not None:
            arm = replace(arm, gravity=read_numbers("--gravity", self.gravity, "3 numbers"))
        if self.payload is not None:
            numbers = read_numbers("--payload", self.payload, "1 or 4 numbers")
            if numbers.size not in (1, 4):
                raise InputError(
                    f"--payload has {format_count(numbers.size, 'number')}; give the mass, kg, or the mass and x, y, z, m"
                )
            center_of_mass = numbers[1:] if numbers.size == 4 else np.zeros(3)
            arm = arm.with_payload(Link(float(numbers[0]), center_of_mass, np.zeros((3, 3)), name="payload"))
        return arm


@dataclass(frozen=True)
class FrictionOptions:
    """Options for the friction of the joints."""

    coulomb: Annotated[
        str | None, "Dry friction of moving joints in N m (N): one number or one per joint. Default: that of the arm."
    ] = None
    stiction: Annotated[
        str | None,
        "Dry friction of joints at rest in N m (N): one number or one per joint. Default: --coulomb, or that of the arm.",
    ] = None
    viscous: Annotated[
        str | None, "Viscous friction in N m s/rad (N s/m): one number or one per joint. Default: that of the arm."
    ] = None
    load_friction: Annotated[
        str | None, "Friction that grows with the gravity torque, as a fraction of it: one number or one per joint.", "0"
    ] = None
    friction: Annotated[
        Path | None,
        "File (YAML) with coulomb, stiction, viscous, load, and brake of joints, and boards, instead of these options.",
    ] = None

    def read_friction(self, arm: Arm) -> Friction:
        """Return the friction that the options describe.

        Raises:
            InputError: A text contains no numbers, the file is wrong, or both are given.
        """
        from holdfast.model.arm.friction import Friction

        texts = {"coulomb": self.coulomb, "stiction": self.stiction, "viscous": self.viscous, "load": self.load_friction}
        given = {name: text for name, text in texts.items() if text is not None}
        if self.friction is not None:
            if given:
                raise InputError("--friction is a file, so --coulomb, --stiction, --viscous, and --load-friction do not apply")
            return Friction.from_file(self.friction, arm)
        numbers: dict[str, Any] = {}
        for name, text in given.items():
            values = read_numbers(f"--{name}", text, f"one number or {arm.n} numbers")
            numbers[name] = values[0] if values.size == 1 else values
        return Friction(**numbers)


CapsulesOption = Annotated[Path | None, "Capsule file (YAML) with the collision model of the links. Default: see --radius."]
RadiusOption = Annotated[float | None, "Radius of the links in m. Default: collision shapes, or 1/20 of total link length."]
MeshesOption = Annotated[Path | None, "Folder that is searched first for the mesh files of the arm."]
CellOption = Annotated[Path | None, "Environment file (YAML): objects that the arm must not touch. Default: none."]


@dataclass(frozen=True)
class ClearanceOptions:
    """Options for the clearance of an arm. With ``--no-clearance``, only the environment is checked."""

    clearance: Annotated[
        bool | None,
        typer.Option(
            "--clearance/--no-clearance",
            help="Avoid self-collisions, or allow them. Default: avoid with --capsules or --radius; unless the arm is planar, "
            "also with --cell or --margin, and always in optimise, recover and assess --optimise.",
        ),
    ] = None
    capsules: CapsulesOption = None
    radius: RadiusOption = None
    meshes: MeshesOption = None
    margin: Annotated[float | None, "Smallest clearance in m; from objects, on top of their margins. Default: 0."] = None
    cell: CellOption = None

    def check_consistency(self) -> None:
        """Raise for contradictory options, before any work is done.

        Raises:
            InputError: Two options contradict each other, or a radius or margin is invalid.
        """
        given_options = [f"--{name}" for name in ("capsules", "radius", "margin") if getattr(self, name) is not None]
        if self.clearance is False and given_options and self.cell is None:
            raise InputError(
                f"{given_options[0]} needs the check for self-collisions that --no-clearance excludes; give one of them"
            )
        if self.capsules is not None and self.radius is not None:
            raise InputError("--capsules and --radius are both given; give one of them (a capsule file can contain a radius)")
        if self.radius is not None and not (math.isfinite(self.radius) and self.radius > 0):
            raise InputError(f"--radius is {self.radius:g}; it must be a finite number of metres above 0")
        if self.margin is not None and not math.isfinite(self.margin):
            raise InputError(f"--margin is {self.margin:g}; it must be a finite number of metres")

    def build_clearance(self, arm: Arm, chooses_configurations: bool = True) -> Clearance | None:
        """Build the clearance to enforce, or return None for none; ``chooses_configurations`` is True if the command chooses
        among configurations.

        Raises:
            InputError: A margin that has no effect, or an environment that cannot be read or does not fit the arm.
            ArmError: A capsule file or radius that does not fit the arm.
        """
        from holdfast.model.collision.capsules import Capsules
        from holdfast.model.collision.clearance import Clearance
        from holdfast.model.collision.clearance_argument import chosen_clearance
        from holdfast.model.shapes.reading import with_mesh_folder

        if self.margin is not None and not chooses_configurations:
            raise InputError("--margin applies to the best configurations, and none are requested; add --optimise")
        arm = arm if self.meshes is None else with_mesh_folder(arm, self.meshes)
        if self.capsules is not None or self.radius is not None:
            shape = Capsules.along_links(arm, self.radius) if self.capsules is None else Capsules.load(self.capsules, arm)
            return chosen_clearance(arm, Clearance(arm, shape, itself=self.clearance is not False), self.cell)
        default_clearance = chosen_clearance(arm, self.clearance, self.cell, looks=chooses_configurations)
        if self.margin is not None and default_clearance is None:
            raise InputError(
                f"--margin has no effect because the clearance of '{arm.name}', an arm that moves in a plane, is not checked "
                f"by default; add --clearance or --capsules"
            )
        return default_clearance

    def build_if_requested(self, arm: Arm) -> Clearance | None:
        """Build the clearance only if an option other than --meshes requests it, else return None."""
        is_requested = self.clearance or any(
            option is not None for option in (self.capsules, self.radius, self.margin, self.cell)
        )
        return self.build_clearance(arm) if is_requested else None


@dataclass(frozen=True)
class ContactOptions:
    """Options for objects that the arm may touch, for commands that report the contacts."""

    cell: Annotated[Path | None, "Environment file (YAML): objects; contacts with them are reported. Default: none."] = None
    capsules: CapsulesOption = None
    radius: RadiusOption = None
    meshes: MeshesOption = None

    def build_contact_clearance(self, arm: Arm) -> Clearance | None:
        """Build the clearance from the collision model and the environment; return None without an environment.

        Raises:
            InputError: A collision model without an environment, or one that cannot be read or does not fit the arm.
            ArmError: A capsule file or radius that does not fit the arm.
        """
        clearance_options = ClearanceOptions(capsules=self.capsules, radius=self.radius, meshes=self.meshes, cell=self.cell)
        clearance_options.check_consistency()
        if self.cell is None:
            for name in ("capsules", "radius", "meshes"):
                if getattr(self, name) is not None:
                    raise InputError(f"--{name} describes an arm that touches an environment, and there is none; add --cell")
            return None
        return replace(clearance_options, clearance=False).build_clearance(arm, chooses_configurations=False)
