"""Arms and their tasks as written on the command line and in study files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from holdfast.core.errors import InputError
from holdfast.core.labels import TASK_ROW_NAMES, is_number

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task


@dataclass(frozen=True)
class ArmSpec:
    """Description of an arm on the command line or in a study file.

    Attributes:
        spec: Built-in name or file; see :func:`holdfast.model.arms.load`.
        base, tip: Links of the file, or None.
        hold: Held joints of the file with their values, rad or m.
        name: Name of the arm; default: the built-in name or the arm's own name.
        group: Group of the SRDF file that gives base and tip, or None.
        xacro: Arguments of a xacro file.
        packages: Folder with ROS packages, or None.
    """

    spec: str
    base: str | None = None
    tip: str | None = None
    hold: Mapping[str, float] = field(default_factory=dict)
    name: str | None = None
    group: str | None = None
    xacro: Mapping[str, str] = field(default_factory=dict)
    packages: str | Path | None = None

    def load(self) -> Arm:
        """Return the arm."""
        from holdfast.model import arms

        options = {each.name: getattr(self, each.name) for each in fields(self) if each.name != "spec"}
        return arms.load(self.spec, **options)


def arm_specs_from_options(
    specs: Sequence[str],
    base: Sequence[str] | None,
    tip: Sequence[str] | None,
    hold: Sequence[str] | None,
    name: Sequence[str] | None,
    group: Sequence[str] | None = None,
    **shared: Any,
) -> list[ArmSpec]:
    """Return several arms; options are given once for all arms, or once for each arm, '-' for none; ``shared`` are for all.

    Raises:
        InputError: An option is given another number of times, or two arms have one name.
    """
    hold_option = [",".join(hold)] if hold and len(specs) == 1 else hold
    options = {"--base": base, "--tip": tip, "--hold": hold_option, "--name": name, "--group": group}
    columns: dict[str, list[str | None]] = {}
    for option, values in options.items():
        option_values = [None if value == "-" else value for value in values or ["-"]]
        if len(option_values) == 1 and (option != "--name" or option_values[0] is None):
            option_values *= len(specs)
        if len(option_values) != len(specs):
            advice = "once for each" if option == "--name" else "once for all, or once for each"
            raise InputError(
                f"{option} is given {len(option_values)} times and there are {len(specs)} arms; give it {advice}, '-' for none"
            )
        columns[option] = option_values
    held_joints = [{} if text is None else parse_held_joints(text) for text in columns["--hold"]]
    names = ("spec", "base", "tip", "hold", "name", "group")
    rows = zip(specs, columns["--base"], columns["--tip"], held_joints, columns["--name"], columns["--group"], strict=True)
    return [ArmSpec(**dict(zip(names, row, strict=True)), **shared) for row in rows]


def parse_held_joints(text: str, option: str = "--hold") -> dict[str, float]:
    """Read ``joint=number`` pairs separated by commas; the joints belong to a file that is not read yet."""
    values_by_joint: dict[str, float] = {}
    for assignment in text.split(","):
        joint, equals, value = (side.strip() for side in assignment.rpartition("="))
        if not (equals and joint and is_number(value)):
            raise InputError(f"{option} '{assignment}' is not joint=number; write for example {option} finger_joint1=0.04")
        if joint in values_by_joint:
            raise InputError(f"{option} gives joint '{joint}' twice; give each joint once")
        values_by_joint[joint] = float(value)
    return values_by_joint


def parse_xacro_arguments(assignments: Sequence[str] | None) -> dict[str, str]:
    """Read the arguments ``NAME=VALUE`` of a xacro file.

    Raises:
        InputError: An argument has no name.
    """
    pairs = [assignment.partition("=") for assignment in assignments or ()]
    wrong = next((name + equals for name, equals, _ in pairs if not (name and equals)), None)
    if wrong is not None:
        raise InputError(f"--xacro '{wrong}' is not NAME=VALUE; write for example --xacro ur_type=ur5e")
    return {name: value for name, _, value in pairs}


def default_task(spec: str, arm: Arm) -> str:
    """Return the default task of an arm: its own task if it is built in, planar if it moves in a plane, else pose."""
    from holdfast.model import arms
    from holdfast.model.arm.task import plane_normal

    if spec in arms.names():
        return arms.about(spec).task
    return "planar" if plane_normal(arm) is not None else "pose"


def read_task(text: str | None, spec: str, arm: Arm, option: str = "--task") -> str | Task:
    """Return a task in the form that the library accepts; ``option`` is its name in error messages."""
    if text is None:
        return default_task(spec, arm)
    from holdfast.model.arm.task import task_from_rows

    frame, _, row_text = text.rpartition(":")
    if frame not in ("", "base", "tool"):
        raise InputError(f"{option}: frame '{frame}' is not known; write rows as 'tool:vx,vy,wz' or 'base:vx,vy,wz'")
    rows = [row_name.strip() for row_name in row_text.split(",") if row_name.strip()]
    if frame or len(rows) > 1 or row_text in TASK_ROW_NAMES:
        return task_from_rows(rows, "tool" if frame == "tool" else "base")
    return row_text
