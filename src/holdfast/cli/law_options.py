"""Options that name a control law, for several commands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray

from holdfast.cli.options import read_numbers
from holdfast.errors import InputError

if TYPE_CHECKING:
    from holdfast.arm import Arm
    from holdfast.arm.task import Task
    from holdfast.control import Law

TargetOption = Annotated[
    str,
    typer.Option(
        "--target",
        help="Where the tool should go, m: as many numbers as the task has rows; with turns x,y,z and quaternion x,y,z,w.",
        show_default=False,
    ),
]
LawOption = Annotated[str, typer.Option("--law", help="pseudoinverse, weighted, damped or failure-tolerant.")]
WeightsOption = Annotated[
    str | None, typer.Option("--weights", help="weighted: one number above 0 per joint, as 1,2,3.", show_default=False)
]
DampingOption = Annotated[
    float | None, typer.Option("--damping", help="damped: the damping, in m for linear rows.", show_default=False)
]
PreFailureOption = Annotated[
    float | None,
    typer.Option(
        "--pre-failure-error",
        help="failure-tolerant: allowed velocity error of the healthy arm, a share of the commanded speed. Default: 0.5.",
        show_default=False,
    ),
]


def read_law(
    name: str,
    arm: Arm,
    task: str | Task,
    weights: str | None,
    damping: float | None,
    pre_failure_error: float | None,
    **more: Any,
) -> Law:
    """The law that --law and its options name; options that were not given are left out."""
    from holdfast.control import by_name

    given: dict[str, Any] = {
        "weights": None if weights is None else read_numbers("--weights", weights, f"{arm.n} numbers"),
        "damping": damping,
        "pre_failure_error": pre_failure_error,
        **more,
    }
    return by_name(name, arm, task=task, **{k: v for k, v in given.items() if v is not None})


def read_target(law: Law, text: str) -> NDArray[np.float64]:
    """--target as the library takes it: the task's rows, or a pose from x,y,z and a quaternion."""
    values = read_numbers("--target", text, "numbers")
    task = law.task
    if values.size == 7:
        from scipy.spatial.transform import Rotation

        if not (np.isfinite(values).all() and np.linalg.norm(values[3:]) > 1e-9):
            raise InputError("--target: the last four numbers are a quaternion x,y,z,w and must not all be 0")
        pose = np.eye(4)
        pose[:3, 3], pose[:3, :3] = values[:3], Rotation.from_quat(values[3:]).as_matrix()
        return pose
    if task.angular or task.frame != "base":
        raise InputError(
            f"--target has {values.size} numbers; task '{task.name}' needs 7, the position x,y,z in m and the quaternion "
            "x,y,z,w"
        )
    if values.size != task.m:
        raise InputError(f"--target has {values.size} numbers; task '{task.name}' needs {task.m}, in m")
    return values
