"""Arguments and options that several commands share, and how text becomes values."""

from __future__ import annotations

import json
import math
import re
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray

from holdfast.errors import InputError

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.arm import Arm
    from holdfast.arm.task import Task
    from holdfast.failures import FailureSpec

ArmArgument = Annotated[
    str, typer.Argument(metavar="ARM", help="Built-in name, URDF file, or DH table (YAML).", show_default=False)
]
BaseOption = Annotated[str | None, typer.Option("--base", help="URDF: base link. Default: the root.", show_default=False)]
TipOption = Annotated[
    str | None, typer.Option("--tip", help="URDF: tip link. Default: the only end there is.", show_default=False)
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON for machines.")]
TASK_HELP = "pose, pointing, position, planar, planar-pose, or rows such as vx,vy,wz or tool:vz. Default: the arm's own."
TaskOption = Annotated[str | None, typer.Option("--task", help=TASK_HELP, show_default=False)]
LengthOption = Annotated[float, typer.Option("--length", help="Characteristic length, m, that divides linear rows.")]
IndexOption = Annotated[
    str,
    typer.Option(
        "--index",
        help="relative-manipulability, manipulability, mean-singular-value, geometric-mean-singular-value, "
        "minimum-singular-value or condition-number.",
    ),
]
FailuresOption = Annotated[
    str,
    typer.Option("--failures", help="single, pairs, a number of joints, or sets such as 'joint2; joint1+joint4' or '2; 1+4'."),
]


def read_arm(spec: str, base: str | None, tip: str | None) -> Arm:
    """The arm that ARM, --base and --tip name."""
    from holdfast import arms

    return arms.resolve(spec, base, tip)


def default_task(spec: str, arm: Arm) -> str:
    """The task of an arm for which none was given: its own, or planar if it moves in a plane, or pose."""
    from holdfast import arms
    from holdfast.arm.task import plane_normal

    if spec in arms.names():
        return arms.about(spec).task
    return "planar" if plane_normal(arm) is not None else "pose"


def read_task(text: str | None, spec: str, arm: Arm) -> str | Task:
    """--task as the library takes it."""
    if text is None:
        return default_task(spec, arm)
    from holdfast.arm.task import ROWS, rows_task

    frame, _, rest = text.rpartition(":")
    if frame not in ("", "base", "tool"):
        raise InputError(f"--task: frame '{frame}' is not known; write rows as 'tool:vx,vy,wz' or 'base:vx,vy,wz'")
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
    """--failures as the library takes it."""
    text = text.strip()
    if text in ("single", "pairs"):
        return text
    # A lone number could be a joint or how many: it is how many, as --help says.
    if text.isdecimal():
        return int(text)
    return [[read_joint(arm, j) for j in part.split("+")] for part in text.split(";") if part.strip()]


def read_configuration(arm: Arm, text: str, degrees: bool) -> NDArray[np.float64]:
    """Joint values separated by commas or spaces; with degrees, of the turning joints (sliding ones stay in m)."""
    q = read_numbers("--q", text, f"{arm.n} numbers")
    q = arm.check_configurations(q)
    if not np.isfinite(q).all():
        raise InputError(f"--q holds NaN or infinity; give {arm.n} finite numbers")
    return np.where(arm.prismatic, q, np.deg2rad(q)) if degrees else q


def read_numbers(option: str, text: str, wanted: str) -> NDArray[np.float64]:
    """Numbers separated by commas or spaces; ``wanted`` says in an error what the option takes."""
    parts = [x for x in re.split(r"[,\s]+", text.strip()) if x]
    try:
        return np.array([float(x) for x in parts])
    except ValueError as error:
        wrong = next(x for x in parts if not _is_number(x))
        raise InputError(f"{option}: '{wrong}' is not a number; give {wanted} separated by commas or spaces") from error


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def plain(value: Any) -> Any:
    """JSON types of NumPy ones; infinity and NaN become null, which JSON has."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def print_json(data: Any) -> None:
    """One JSON document on stdout."""
    typer.echo(json.dumps(plain(data), indent=2))


def number(value: float | np.floating[Any], digits: int = 4) -> str:
    """A value for a table; rounding noise about 0 is 0."""
    value = float(value)
    if not math.isfinite(value):
        return "infinite" if math.isinf(value) else "none"
    return "0" if abs(value) < 1e-12 else f"{value:.{digits}g}"


def console() -> Console:
    """Where tables for people go; wide when no terminal says how wide it is, so that names are not cut."""
    from rich.console import Console

    wide = Console(highlight=False)
    return wide if wide.is_terminal else Console(highlight=False, width=140)
