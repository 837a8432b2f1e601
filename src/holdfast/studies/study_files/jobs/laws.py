"""Jobs of motions under a law: their plan, and the law that it defines."""

from __future__ import annotations

from dataclasses import dataclass

from holdfast.control.laws.law import Law
from holdfast.core.registry import LAW_REGISTRY
from holdfast.core.typing import T
from holdfast.model.arm.task import Task
from holdfast.model.arms.serial import from_dict
from holdfast.studies.study_files.jobs.process import PlannedJob


@dataclass(frozen=True, eq=False)
class PlannedLaw(PlannedJob[T]):
    """Job whose plan names a law.

    Attributes:
        plan: Arm, task, law and what the job itself asks for.
    """

    def make_law(self) -> Law:
        """Return the law of the plan."""
        task = Task.from_dict(self.plan["task"])
        plan_law: Law = LAW_REGISTRY.make(self.plan["law"], from_dict(self.plan["arm"]), option="laws", task=task)
        return plan_law


@dataclass(frozen=True, eq=False)
class LawJob(PlannedLaw[Law]):
    """Job that compiles its law and nothing else."""

    def compile_plan(self) -> Law:
        """Return the law."""
        return self.make_law()
