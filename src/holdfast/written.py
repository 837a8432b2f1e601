"""Tasks, joints and failures as people write them, on the command line and in study files."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.grammar import is_number

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task
    from holdfast.failures import FailureSpec


@dataclass(frozen=True)
class ArmSpec:
    """An arm as people name it.

    Attributes:
        spec: Built-in name or file; see :func:`holdfast.arms.resolve`.
        base, tip: Links of the file, if chosen.
        hold: Joints of the file that stand for good, and where, rad or m.
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

        arm = arms.resolve(self.spec, self.base, self.tip, self.hold)
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


def check_unit_of_joints(arm: Arm, q: NDArray[np.float64], option: str, degrees: bool = False) -> None:
    """Refuse joint values (n,), rad and m, so far beyond the limits that they must be degrees, or millimetres.

    Raises:
        InputError: A joint is more than a turn, or ten times its range, beyond its limits.
    """
    unit = "degrees" if degrees else "radians, or degrees with --degrees"
    for joint, value in zip(arm.joints, q.tolist(), strict=True):
        factor, shown = joint.shown if degrees else (1.0, joint.unit)
        bounded = np.isfinite(joint.upper - joint.lower)
        room = 10 * (joint.upper - joint.lower) if joint.prismatic else 2 * np.pi
        low, high = (joint.lower, joint.upper) if bounded else (-2 * np.pi, 2 * np.pi)
        if (bounded or not joint.prismatic) and not low - room <= value <= high + room:
            limits = f"its limits, {factor * low:.4g} to {factor * high:.4g} {shown}" if bounded else "a turn"
            raise InputError(
                f"{option}: joint '{joint.name}' is at {factor * value:.6g} {shown}, far beyond {limits}; give "
                f"{'metres' if joint.prismatic else unit}"
            )


def check_unit_of_places(arm: Arm, places: NDArray[np.float64], option: str) -> None:
    """Refuse places (3,) or (N, 3), m, so far from an arm that they must be millimetres.

    Raises:
        InputError: A place is more than ten times as far from the base as the arm, stretched out, could be long.
    """
    strokes = sum(max(abs(j.lower), abs(j.upper)) for j in arm.joints if j.prismatic)
    parts = [*(j.origin for j in arm.joints), arm.tool]
    longest = sum(float(np.linalg.norm(part[:3, 3])) for part in parts) + strokes
    away = float(np.linalg.norm(np.atleast_2d(places) - arm.base[:3, 3], axis=1).max(initial=0.0))
    if np.isfinite(longest) and away > 10 * longest:
        raise InputError(
            f"{option}: a place is {away:.4g} m from the base of '{arm.name}', which is at most {longest:.4g} m long; "
            "give metres"
        )


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
    from holdfast.arm.task import ROWS, rows_task

    frame, _, rest = text.rpartition(":")
    if frame not in ("", "base", "tool"):
        raise InputError(f"{option}: frame '{frame}' is not known; write rows as 'tool:vx,vy,wz' or 'base:vx,vy,wz'")
    rows = [x.strip() for x in rest.split(",") if x.strip()]
    if frame or len(rows) > 1 or rest in ROWS:
        return rows_task(rows, "tool" if frame == "tool" else "base")
    return rest


def read_joint(arm: Arm, text: str) -> int:
    """A joint by name or number from 1, as an index from 0."""
    text = text.strip()
    if text in arm.joint_names:
        return arm.joint_index(text)
    if text.isdecimal():
        if 1 <= int(text) <= arm.n:
            return int(text) - 1
        raise InputError(f"joint {text} is out of range; '{arm.name}' has joints 1 to {arm.n}")
    return arm.joint_index(text)


def read_failures(arm: Arm, text: str) -> FailureSpec:
    """Failures as the library takes them."""
    text = text.strip()
    if text in ("single", "pairs"):
        return text
    # A lone number could be a joint or how many: it is how many, as --help says.
    if text.isdecimal():
        return int(text)
    return [[read_joint(arm, j) for j in part.split("+")] for part in text.split(";") if part.strip()]


def read_numbers(option: str, text: str, wanted: str) -> NDArray[np.float64]:
    """Numbers separated by commas or spaces; ``wanted`` says in an error what the option takes."""
    parts = [x for x in re.split(r"[,\s]+", text.strip()) if x]
    try:
        return np.array([float(x) for x in parts])
    except ValueError as error:
        wrong = next(x for x in parts if not is_number(x))
        raise InputError(f"{option}: '{wrong}' is not a number; give {wanted} separated by commas or spaces") from error
