"""Convergence maps as cells of a study: random motions under a law, with each joint locked and without failure."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.control.convergence.maps import convergence_map
from holdfast.control.laws.law import Law
from holdfast.core.sweeps.job import Chunk
from holdfast.core.sweeps.samples import Column
from holdfast.core.typing import Rows
from holdfast.model.arm.model import Arm
from holdfast.model.collision.clearance import Clearance
from holdfast.model.collision.clearance_argument import chosen_clearance, decode_clearance, encode_clearance
from holdfast.studies.study_files.jobs.process import PlannedLaw


def describe_surroundings(arm: Arm, cell: Path | None) -> dict[str, Any]:
    """Return the entries of a plan for the cell around an arm, which are empty without a cell."""
    clearance = chosen_clearance(arm, False, cell, looks=False)
    return {} if clearance is None else encode_clearance(clearance)


@dataclass(frozen=True, eq=False)
class ConvergenceJob(PlannedLaw[tuple[Law, Clearance | None]]):
    """Job of motions between random poses of :func:`holdfast.convergence_map`, with one row for each motion.

    Attributes:
        plan: Arm, task, law, and time limit, and the objects around the arm if contacts are checked.
    """

    def compile_plan(self) -> tuple[Law, Clearance | None]:
        """Return the law, and the clearance for the contact check of the motions."""
        law = self.make_law()
        return law, decode_clearance(law.arm, self.plan)

    def columns(self) -> list[Column]:
        """Return the columns of the results; see :class:`holdfast.core.sweeps.SweepJob`."""
        law, clearance = self.compiled_parts
        n = law.arm.n
        locked = (("locked_or_none", n + 1),)
        return [
            Column(
                "q0", "float64", (("joint", n),), units="rad or m", about="configuration at the start; NaN where none was found"
            ),
            Column("target", "float64", (("row", 4), ("column", 4)), units="m", about="tool pose"),
            Column("code", "uint8", locked, units="1", about="0 converged, 1 stuck, 2 moving, 3 undecided, 255 none"),
            Column("reason", "uint8", locked, units="1", about="why a run is undecided"),
            Column("in_reach", "uint8", locked, units="1", about="1 if the end effector came to the target, or could have"),
            Column("limits_passed", "uint8", locked, units="1", about="1 if a joint left its limits"),
            *([] if clearance is None else [Column("touched", "uint8", locked, units="1", about="1 if something is touched")]),
        ]

    def run(self, chunk: Chunk) -> Rows:
        """Compute the rows of a chunk; see :class:`holdfast.core.sweeps.SweepJob`."""
        law, clearance = self.compiled_parts
        count = len(chunk)
        time_limit = self.plan["time_limit"]
        result = convergence_map(
            law, count, count, configurations=1, time_limit=time_limit, seed=chunk.own_seed, clearance=clearance
        )
        touched = {} if result.touched is None else {"touched": result.touched[:, 0].astype(np.uint8)}
        return {
            "q0": result.q0[:, 0],
            "target": result.target[:, 0],
            "code": result.code[:, 0],
            "reason": result.reason[:, 0],
            "in_reach": result.in_reach[:, 0].astype(np.uint8),
            "limits_passed": result.limits_passed[:, 0].astype(np.uint8),
            **touched,
        }
