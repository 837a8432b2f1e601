"""Options for the control law, the target, and the locked joints, shared by several commands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from holdfast.core.labels import is_count
from holdfast.core.registry import LAW_REGISTRY
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import TARGET_HELP, SeedOption, TaskOption
from holdfast.interface.cli.values import read_target, read_task

if TYPE_CHECKING:
    from holdfast.control.laws.law import Law
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task

TargetOption = Annotated[str, TARGET_HELP]
OptionalTargetOption = Annotated[str | None, TARGET_HELP]
TargetsOption = Annotated[str, f"{TARGET_HELP} Several targets: a lattice (grid:12) or random positions (random:200)."]
LAW_HELP = "Control law: " + LAW_REGISTRY.usage.replace("; ", ";\n\n")  # a law per line
LawsOption = Annotated[list[str] | None, f"{LAW_HELP}.\n\nRepeatable.", "pseudoinverse and failure-tolerant"]
LockDegreesOption = Annotated[bool, "Read --lock in degrees (prismatic joints: m)."]


@dataclass(frozen=True)
class LawOptions(ArmSourceOptions):
    """Options for the control law of an arm, and its task."""

    law: Annotated[str, f"{LAW_HELP}."] = "pseudoinverse"
    task: TaskOption = None

    def read_law(self, arm: str, **settings: Any) -> Law:
        """Create the law for the arm that ``arm`` names."""
        model = self.resolve_arm(arm)
        return read_law(self.law, model, read_task(self.task, arm, model), **settings)


@dataclass(frozen=True)
class SeededLawOptions(LawOptions):
    """Options for a control law, and the seed."""

    seed: SeedOption = 0


@dataclass(frozen=True)
class ClosedLoopOptions:
    """Options for the simulation of a control law."""

    gain: Annotated[float, "Feedback gain Ke in 1/s, or per cycle with --cycles."] = 1.0
    speed_limit: Annotated[float | None, "Speed limit of the end effector in m/s (--cycles: m/cycle). Default: none."] = None
    cycles: Annotated[bool, "Simulate discrete control cycles instead of continuous time."] = False
    time_limit: Annotated[float | None, "Time limit in s, or in cycles with --cycles.", "3000/gain s, or 1000 cycles"] = None


def read_law(label: str, arm: Arm, task: str | Task, option: str = "--law", **settings: Any) -> Law:
    """Create the law that --law names; errors refer to ``option``."""
    law: Law = LAW_REGISTRY.make(label, arm, option=option, task=task, **settings)
    return law


def read_laws(labels: list[str] | None, arm: Arm, task: str | None, spec: str, **settings: Any) -> list[Law]:
    """Create the laws to compare, for the arm that ``spec`` names."""
    common_task = read_task(task, spec, arm)
    return [read_law(label, arm, common_task, **settings) for label in labels or ["pseudoinverse", "failure-tolerant"]]


def read_position_sampling(text: str) -> str | int:
    """Read a lattice, or a number of random positions."""
    text = text.removeprefix("random:")
    return int(text) if is_count(text) else text


def read_targets(law: Law, text: str) -> Any:
    """Read ``--target`` as an argument of the library where it may be one target or many."""
    is_set = text.startswith(("grid", "random:"))
    return read_position_sampling(text) if is_set else read_target(law.arm, law.task, text)
