"""Options that name a control law, for several commands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from holdfast.cli.options import TARGET_HELP
from holdfast.registry import LAWS

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task
    from holdfast.control.law import Law

TargetOption = Annotated[
    str,
    typer.Option(
        "--target",
        help=TARGET_HELP,
        show_default=False,
    ),
]
LAW_HELP = f"{LAWS.usage}."
LawOption = Annotated[str, typer.Option("--law", help=LAW_HELP)]
LawsOption = Annotated[
    list[str] | None,
    typer.Option(
        "--law",
        help=f"A law to compare: {LAW_HELP} May be given again; the others are compared with the first.",
        show_default="pseudoinverse and failure-tolerant",
    ),
]


def read_law(label: str, arm: Arm, task: str | Task, option: str = "--law", **more: Any) -> Law:
    """The law that --law names; ``option`` is what an error calls it."""
    law: Law = LAWS.make(label, arm, option=option, task=task, **more)
    return law
