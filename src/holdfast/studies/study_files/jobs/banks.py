"""Task banks as cells of a study: random tasks that a law executes without an operator, healthy and failed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.registry import LAW_REGISTRY
from holdfast.core.sweeps.job import Chunk
from holdfast.core.sweeps.samples import Column
from holdfast.core.typing import Rows
from holdfast.studies.study_files.jobs.process import LawJob
from holdfast.teleop.bank.tasks import make_task_bank
from holdfast.teleop.trials.performance import RECORDED_MEASURES
from holdfast.teleop.trials.scenarios import Scenario


class BankJob(LawJob):
    """Job of tasks of :func:`holdfast.teleop.make_task_bank`, with one row for a task for each joint that fails.

    Attributes:
        plan: Arm, task, law, and distance.
    """

    def columns(self) -> list[Column]:
        """Return the columns of the results; see :class:`holdfast.core.sweeps.SweepJob`."""
        law = self.compiled_parts
        joints = ("failing", law.arm.n)
        cases, measures = ("healthy_or_failed", 2), ("measure", RECORDED_MEASURES)
        return [
            Column("q0", "float64", (joints, ("joint", law.arm.n)), units="rad or m", about="configuration at the start"),
            Column("target", "float64", (joints, ("row", law.task.m)), units="m", about="where the end effector should go"),
            Column("end", "uint8", (joints, cases), units="1", about="how the trial ended; 0 arrived"),
            Column("measures", "float64", (joints, cases, measures), units="mixed", about="M1 to M11 of Goel et al. 2003"),
        ]

    def run(self, chunk: Chunk) -> Rows:
        """Compute the rows of a chunk; see :class:`holdfast.core.sweeps.SweepJob`."""
        law = self.compiled_parts
        count, n = len(chunk), law.arm.n
        entry, options = LAW_REGISTRY.read_label(self.plan["law"], "laws")
        scenarios = [Scenario(number + 1, entry.name, failed, options=options) for number, failed in enumerate((False, True))]
        bank = make_task_bank(
            law.arm, count, None, distance=self.plan["distance"], task=law.task, seed=chunk.own_seed, scenarios=scenarios
        )

        def arrange_by_row(values: NDArray[Any]) -> NDArray[Any]:
            """Return values (n * count, ...), joint by joint, as (count, n, ...)."""
            return np.ascontiguousarray(values.reshape(n, count, *values.shape[1:]).swapaxes(0, 1))

        return {
            "q0": arrange_by_row(bank.tasks.q0),
            "target": arrange_by_row(bank.tasks.target),
            "end": arrange_by_row(bank.end.T),
            "measures": arrange_by_row(bank.measures.swapaxes(0, 1)),
        }
