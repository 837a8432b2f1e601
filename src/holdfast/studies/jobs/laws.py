"""What jobs of motions under a law share: their plan, and the law that it defines."""

from __future__ import annotations

from dataclasses import dataclass

from holdfast.arm.task import Task
from holdfast.arms.serial import from_dict
from holdfast.control.law import Law
from holdfast.registry import LAWS
from holdfast.studies.jobs.process import PlannedJob, T


@dataclass(frozen=True, eq=False)
class PlannedLaw(PlannedJob[T]):
    """A job whose plan names a law.

    Attributes:
        plan: Arm, task, law and what the job itself asks for.
    """

    def law(self) -> Law:
        """The law of the plan."""
        task = Task.from_dict(self.plan["task"])
        made: Law = LAWS.make(self.plan["law"], from_dict(self.plan["arm"]), option="laws", task=task)
        return made


@dataclass(frozen=True, eq=False)
class LawJob(PlannedLaw[Law]):
    """A job that compiles its law and nothing else."""

    def compiled(self) -> Law:
        """The law."""
        return self.law()
