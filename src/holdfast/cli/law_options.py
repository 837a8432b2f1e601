"""Options that name a control law, for several commands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from holdfast.cli.options import TARGET_HELP
from holdfast.written import read_labelled_law as read_labelled_law
from holdfast.written import read_numbers

if TYPE_CHECKING:
    from holdfast.arm import Arm
    from holdfast.arm.task import Task
    from holdfast.control import Law

TargetOption = Annotated[
    str,
    typer.Option(
        "--target",
        help=TARGET_HELP,
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


LawsOption = Annotated[
    list[str] | None,
    typer.Option(
        "--law",
        help="A law to compare, with its setting after a colon: pseudoinverse, failure-tolerant or failure-tolerant:0.3, "
        "damped:0.1, weighted:1,2,3. May be given again; the others are compared with the first.",
        show_default="pseudoinverse and failure-tolerant",
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
