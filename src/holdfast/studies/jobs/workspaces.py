"""Workspaces as cells of a study: from which starts a target is still reached."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast.convergence.analysis import Beginnings, Job, prepared, usual_method
from holdfast.convergence.places import Places, read_places
from holdfast.engine.job import Chunk
from holdfast.engine.store import Column
from holdfast.errors import InputError
from holdfast.studies.jobs.laws import PlannedLaw

Rows = dict[str, NDArray[Any]]


@dataclass(frozen=True, eq=False)
class WorkspaceJob(PlannedLaw[tuple[Job, Places]]):
    """Starts, random ones, looked at as :func:`holdfast.workspace` does, a chunk with its own seed; a row is a start.

    Attributes:
        plan: Arm, task, law, target, configurations and points of each start, time limit, seed.
        rows: Starts in all.
    """

    rows: int

    def compiled(self) -> tuple[Job, Places]:
        """What all starts share, and the places that they are drawn from."""
        p = self.plan
        law = self.law()
        method = usual_method(law)
        job = prepared(law, p["target"], p["configurations"], p["points"], method, time_limit=p["time_limit"], seed=p["seed"])
        if not job.reached:
            raise InputError(f"no configuration of '{law.arm.name}' was found at the target; choose one within its reach")
        places = read_places(law.arm, law.task, self.rows, np.random.default_rng(p["seed"]))
        return job, places

    def columns(self) -> list[Column]:
        """See :class:`holdfast.engine.Job`."""
        return self.made[0].store_columns()

    def run(self, chunk: Chunk) -> Rows:
        """See :class:`holdfast.engine.Job`."""
        job, places = self.made
        mine = Places(places.poses[chunk.start : chunk.stop])
        begin = Beginnings(job.law, mine, job.configurations, job.method, chunk.own_seed)
        return job.analyse(*begin.of(0, len(chunk)), len(chunk))
