"""Options that name a control law, what it should do and what has locked, for several commands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from holdfast.cli.options import TARGET_HELP
from holdfast.cli.values import read_target, read_task
from holdfast.grammar import is_count
from holdfast.registry import LAWS

if TYPE_CHECKING:
    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task
    from holdfast.cli.groups import Chain
    from holdfast.control.law import Law

TargetOption = Annotated[str, TARGET_HELP]
TargetsOption = Annotated[str, f"{TARGET_HELP} Many targets: a lattice (grid:12) or a number of random ones (random:200)."]
LAW_HELP = f"{LAWS.usage}."
LawOption = Annotated[str, LAW_HELP]
LawsOption = Annotated[
    list[str] | None, f"A law to compare: {LAW_HELP} May be given again.", "pseudoinverse and failure-tolerant"
]
GainOption = Annotated[float, "Feedback gain Ke, per s or per cycle."]
SpeedLimitOption = Annotated[float | None, "Of the end effector, m/s or m per cycle. Default: none."]
CyclesOption = Annotated[bool, "Discrete control cycles in place of continuous time."]
TimeLimitOption = Annotated[float | None, "Time limit, s or cycles.", "3000/gain s, or 1000 cycles"]
LockDegreesOption = Annotated[bool, "--lock is in degrees (prismatic joints stay in m)."]


def read_law(label: str, arm: Arm, task: str | Task, option: str = "--law", **more: Any) -> Law:
    """The law that --law names; ``option`` is what an error calls it."""
    law: Law = LAWS.make(label, arm, option=option, task=task, **more)
    return law


def read_laws(labels: list[str] | None, arm: Arm, task: str | None, spec: str, **more: Any) -> list[Law]:
    """The laws to compare, for the arm that ``spec`` names."""
    chosen = read_task(task, spec, arm)
    return [read_law(label, arm, chosen, **more) for label in labels or ["pseudoinverse", "failure-tolerant"]]


def law_of(label: str, arm: str, task: str | None, chain: Chain, **more: Any) -> Law:
    """The law that --law, ARM, --task and the options of the chain name."""
    model = chain.arm(arm)
    return read_law(label, model, read_task(task, arm, model), **more)


def read_places(text: str) -> str | int:
    """A lattice as it is written, or a number of random places."""
    text = text.removeprefix("random:")
    return int(text) if is_count(text) else text


def read_targets(law: Law, text: str) -> Any:
    """--target as the library takes it where it may be one or many."""
    many = text.startswith(("grid", "random:"))
    return read_places(text) if many else read_target(law.arm, law.task, text)
