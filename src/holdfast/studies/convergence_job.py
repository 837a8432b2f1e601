"""Maps of how failed arms end as cells of a study: random motions under a law, with each joint locked and with none."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.serial import from_dict
from holdfast.arm.task import Task
from holdfast.control.law import Law
from holdfast.converge.convergence_map import convergence_map
from holdfast.studies.process import ready, shared
from holdfast.study import Chunk, Column
from holdfast.written import read_labelled_law

Rows = dict[str, NDArray[Any]]


def law_of(plan: dict[str, Any]) -> Law:
    """The law of a plan."""
    t = plan["task"]
    task = Task(t["name"], np.array(t["rows"]), t["frame"], t["length"])
    return read_labelled_law(plan["law"], from_dict(plan["arm"]), task, "laws")


@dataclass(frozen=True)
class ConvergenceJob:
    """Motions between random places, as :func:`holdfast.convergence_map` makes them; a row is a motion.

    Attributes:
        plan: Arm, task, law, time limit.
    """

    plan: dict[str, Any]

    def __hash__(self) -> int:
        return hash((self.plan["fingerprint"], self.plan["law"]))

    def prepare(self, alone: bool) -> None:
        """See :class:`holdfast.study.Job`."""
        ready(self, self._law, alone)

    def _law(self) -> Law:
        return law_of(self.plan)

    def columns(self) -> list[Column]:
        """See :class:`holdfast.study.Job`."""
        n = shared(self, self._law).arm.n
        locked = (("locked_or_none", n + 1),)
        return [
            Column("q0", "float64", (("joint", n),), "rad or m", "configuration at the start; NaN where none was found"),
            Column("target", "float64", (("row", 4), ("column", 4)), "m", "tool pose"),
            Column("code", "uint8", locked, "1", "0 converged, 1 stuck, 2 moving, 3 undecided, 255 none"),
            Column("reason", "uint8", locked, "1", "why a run is undecided"),
            Column("in_reach", "uint8", locked, "1", "1 if the hand came to the target, or could have"),
            Column("limits_passed", "uint8", locked, "1", "1 if a joint left its limits"),
        ]

    def run(self, chunk: Chunk) -> Rows:
        """See :class:`holdfast.study.Job`."""
        law = shared(self, self._law)
        count = len(chunk)
        found = convergence_map(law, count, count, 1, time_limit=self.plan["time_limit"], seed=chunk.own_seed)
        return {
            "q0": found.q0[:, 0],
            "target": found.target[:, 0],
            "code": found.code[:, 0],
            "reason": found.reason[:, 0],
            "in_reach": found.in_reach[:, 0].astype(np.uint8),
            "limits_passed": found.limits_passed[:, 0].astype(np.uint8),
        }
