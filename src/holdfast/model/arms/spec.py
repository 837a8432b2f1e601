"""Arms and their tasks as written on the command line and in study files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from holdfast.core.errors import InputError
from holdfast.core.labels import TASK_ROW_NAMES, is_number

if TYPE_CHECKING:
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task


@dataclass(frozen=True)
class ArmSpec:
    """Description of an arm on the command line or in a study file.

    Attributes:
        spec: Built-in name or file; see :func:`holdfast.model.arms.resolve`.
        base, tip: Links of the file, or None.
        hold: Held joints of the file with their values, rad or m.
        name: Name of the arm; default: the built-in name or the arm's own name.
    """

    spec: str
    base: str | None = None
    tip: str | None = None
    hold: Mapping[str, float] = field(default_factory=dict)
    name: str | None = None

    def load(self) -> Arm:
        """Return the arm."""
        from holdfast.model import arms

        arm = arms.resolve(self.spec, self.base, self.tip, hold=self.hold)
        return arm if self.name is None else replace(arm, name=self.name)


def arm_specs_from_options(
    specs: Sequence[str],
    base: Sequence[str] | None,
    tip: Sequence[str] | None,
    hold: Sequence[str] | None,
    name: Sequence[str] | None,
) -> list[ArmSpec]:
    """Return several arms; --base, --tip, and --hold are given once for all arms, or once for each arm, '-' for none.

    Raises:
        InputError: An option is given another number of times, or two arms have one name.
    """
    hold_option = [",".join(hold)] if hold and len(specs) == 1 else hold
    options = {"--base": base, "--tip": tip, "--hold": hold_option, "--name": name}
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
    rows = zip(specs, *columns.values(), strict=True)
    return [
        ArmSpec(spec_text, base_link, tip_link, {} if hold_text is None else parse_held_joints(hold_text), arm_name)
        for spec_text, base_link, tip_link, hold_text, arm_name in rows
    ]


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
