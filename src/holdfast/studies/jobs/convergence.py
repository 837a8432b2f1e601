"""Maps of how failed arms end as cells of a study: random motions under a law, with each joint locked and with none."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.convergence.maps import convergence_map
from holdfast.engine.job import Chunk
from holdfast.engine.store import Column
from holdfast.studies.jobs.laws import LawJob

Rows = dict[str, NDArray[Any]]


class ConvergenceJob(LawJob):
    """Motions between random places, as :func:`holdfast.convergence_map` makes them; a row is a motion.

    Attributes:
        plan: Arm, task, law, time limit.
    """

    def columns(self) -> list[Column]:
        """See :class:`holdfast.engine.Job`."""
        n = self.made.arm.n
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
        ]

    def run(self, chunk: Chunk) -> Rows:
        """See :class:`holdfast.engine.Job`."""
        law = self.made
        count = len(chunk)
        found = convergence_map(law, count, count, configurations=1, time_limit=self.plan["time_limit"], seed=chunk.own_seed)
        return {
            "q0": found.q0[:, 0],
            "target": found.target[:, 0],
            "code": found.code[:, 0],
            "reason": found.reason[:, 0],
            "in_reach": found.in_reach[:, 0].astype(np.uint8),
            "limits_passed": found.limits_passed[:, 0].astype(np.uint8),
        }
