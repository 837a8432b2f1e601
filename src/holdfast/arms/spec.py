"""Arms and their tasks as people write them, on the command line and in study files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from holdfast.errors import InputError
from holdfast.grammar import ROWS, is_number

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task


@dataclass(frozen=True)
class ArmSpec:
    """An arm as people name it.

    Attributes:
        spec: Built-in name or file; see :func:`holdfast.arms.resolve`.
        base, tip: Links of the file, if chosen.
        hold: Joints of the file that are held, and where, rad or m.
        name: What it is called; the built-in name or the arm's own if not given.
    """

    spec: str
    base: str | None = None
    tip: str | None = None
    hold: Mapping[str, float] = field(default_factory=dict)
    name: str | None = None

    def load(self) -> Arm:
        """The arm."""
        from holdfast import arms

        arm = arms.resolve(self.spec, self.base, self.tip, hold=self.hold)
        return arm if self.name is None else replace(arm, name=self.name)


def each_arm(
    specs: Sequence[str],
    base: Sequence[str] | None,
    tip: Sequence[str] | None,
    hold: Sequence[str] | None,
    name: Sequence[str] | None,
) -> list[ArmSpec]:
    """Several arms; --base, --tip and --hold were given once for all, or each once for each arm, '-' for none.

    Raises:
        InputError: A number of options that is neither, or two arms of one name.
    """
    held = [",".join(hold)] if hold and len(specs) == 1 else hold
    given = {"--base": base, "--tip": tip, "--hold": held, "--name": name}
    columns: dict[str, list[str | None]] = {}
    for option, values in given.items():
        found = [None if value == "-" else value for value in values or ["-"]]
        if len(found) == 1 and (option != "--name" or found[0] is None):
            found *= len(specs)
        if len(found) != len(specs):
            once = "once for each" if option == "--name" else "once for all, or once for each"
            raise InputError(
                f"{option} is given {len(found)} times and there are {len(specs)} arms; give it {once}, '-' for none"
            )
        columns[option] = found
    rows = zip(specs, *columns.values(), strict=True)
    return [ArmSpec(s, b, t, {} if h is None else read_hold(h), n) for s, b, t, h, n in rows]


def read_hold(text: str, option: str = "--hold") -> dict[str, float]:
    """``joint=number`` separated by commas; the joints are those of a file that is not read yet."""
    found: dict[str, float] = {}
    for part in text.split(","):
        joint, equals, value = (x.strip() for x in part.rpartition("="))
        if not (equals and joint and is_number(value)):
            raise InputError(f"{option} '{part}' is not joint=number; write for example {option} finger_joint1=0.04")
        if joint in found:
            raise InputError(f"{option} gives joint '{joint}' twice; give each joint once")
        found[joint] = float(value)
    return found


def default_task(spec: str, arm: Arm) -> str:
    """The task of an arm for which none was given: its own, or planar if it moves in a plane, or pose."""
    from holdfast import arms
    from holdfast.arm.task import plane_normal

    if spec in arms.names():
        return arms.about(spec).task
    return "planar" if plane_normal(arm) is not None else "pose"


def read_task(text: str | None, spec: str, arm: Arm, option: str = "--task") -> str | Task:
    """A task as the library takes it; ``option`` is what an error calls it."""
    if text is None:
        return default_task(spec, arm)
    from holdfast.arm.task import rows_task

    frame, _, rest = text.rpartition(":")
    if frame not in ("", "base", "tool"):
        raise InputError(f"{option}: frame '{frame}' is not known; write rows as 'tool:vx,vy,wz' or 'base:vx,vy,wz'")
    rows = [x.strip() for x in rest.split(",") if x.strip()]
    if frame or len(rows) > 1 or rest in ROWS:
        return rows_task(rows, "tool" if frame == "tool" else "base")
    return rest
