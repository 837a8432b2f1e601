"""Task banks as cells of a study: random tasks that the computer drives under a law, healthy and failed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.engine.job import Chunk
from holdfast.engine.store import Column
from holdfast.registry import LAWS
from holdfast.studies.jobs.laws import LawJob
from holdfast.teleop.bank.tasks import task_bank
from holdfast.teleop.trials.performance import RECORDED
from holdfast.teleop.trials.scenarios import Scenario

Rows = dict[str, NDArray[Any]]


class BankJob(LawJob):
    """Tasks as :func:`holdfast.teleop.task_bank` makes them; a row is a task for each joint that fails.

    Attributes:
        plan: Arm, task, law, distance.
    """

    def columns(self) -> list[Column]:
        """See :class:`holdfast.engine.Job`."""
        law = self.made
        joints = ("failing", law.arm.n)
        cases = ("healthy_or_failed", 2)
        return [
            Column("q0", "float64", (joints, ("joint", law.arm.n)), units="rad or m", about="configuration at the start"),
            Column("target", "float64", (joints, ("row", law.task.m)), units="m", about="where the end effector should go"),
            Column("end", "uint8", (joints, cases), units="1", about="how the trial ended; 0 arrived"),
            Column(
                "measures",
                "float64",
                (joints, cases, ("measure", RECORDED)),
                units="mixed",
                about="M1 to M11 of Goel et al. 2003",
            ),
        ]

    def run(self, chunk: Chunk) -> Rows:
        """See :class:`holdfast.engine.Job`."""
        law = self.made
        count, n = len(chunk), law.arm.n
        entry, options = LAWS.read(self.plan["law"], "laws")
        scenarios = [Scenario(k + 1, entry.name, failed, options=options) for k, failed in enumerate((False, True))]
        bank = task_bank(
            law.arm, count, None, distance=self.plan["distance"], task=law.task, seed=chunk.own_seed, scenarios=scenarios
        )

        def by_row(values: NDArray[Any]) -> NDArray[Any]:
            """(n * count, ...), joint by joint, as (count, n, ...)."""
            return np.ascontiguousarray(values.reshape(n, count, *values.shape[1:]).swapaxes(0, 1))

        return {
            "q0": by_row(bank.tasks.q0),
            "target": by_row(bank.tasks.target),
            "end": by_row(bank.end.T),
            "measures": by_row(bank.measures.swapaxes(0, 1)),
        }
