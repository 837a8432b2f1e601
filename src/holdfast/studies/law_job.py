"""What jobs of motions under a law share: their plan, and the law that it defines."""

from __future__ import annotations

from dataclasses import dataclass

from holdfast.arm.serial import from_dict
from holdfast.arm.task import Task
from holdfast.control.law import Law
from holdfast.studies.process import PlannedJob, T
from holdfast.written import read_labelled_law


@dataclass(frozen=True, eq=False)
class PlannedLaw(PlannedJob[T]):
    """A job whose plan names a law.

    Attributes:
        plan: Arm, task, law and what the job itself asks for.
    """

    def law(self) -> Law:
        """The law of the plan."""
        task = Task.from_dict(self.plan["task"])
        return read_labelled_law(self.plan["law"], from_dict(self.plan["arm"]), task, "laws")


@dataclass(frozen=True, eq=False)
class LawJob(PlannedLaw[Law]):
    """A job that compiles its law and nothing else."""

    def compiled(self) -> Law:
        """The law."""
        return self.law()
