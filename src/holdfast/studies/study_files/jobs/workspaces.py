"""Workspaces as cells of a study, with the starts from which a target is still reached."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from holdfast.control.convergence.analysis import StartConfigurations, TargetAnalysis, choose_method, prepare_analysis
from holdfast.control.convergence.places import Places, read_places
from holdfast.core.errors import InputError
from holdfast.core.sweeps.job import Chunk
from holdfast.core.sweeps.samples import Column
from holdfast.core.typing import Rows
from holdfast.studies.study_files.jobs.process import PlannedLaw


@dataclass(frozen=True, eq=False)
class WorkspaceJob(PlannedLaw[tuple[TargetAnalysis, Places]]):
    """Job of random starts of :func:`holdfast.workspace`, with a seed for each chunk and one row for each start.

    Attributes:
        plan: Arm, task, law, target, configurations and points of each start, time limit, and seed.
        rows: Number of all starts.
    """

    rows: int

    def compile_plan(self) -> tuple[TargetAnalysis, Places]:
        """Return the job that all starts share, and the poses from which they are sampled."""
        plan = self.plan
        law = self.make_law()
        method = choose_method(law)
        job = prepare_analysis(
            law,
            plan["target"],
            plan["configurations"],
            plan["points"],
            method,
            time_limit=plan["time_limit"],
            seed=plan["seed"],
        )
        if not job.is_reached:
            raise InputError(f"no configuration of '{law.arm.name}' was found at the target; choose one within its reach")
        places = read_places(law.arm, law.task, self.rows, np.random.default_rng(plan["seed"]))
        return job, places

    def columns(self) -> list[Column]:
        """Return the columns of the results; see :class:`holdfast.core.sweeps.SweepJob`."""
        return self.compiled_parts[0].store_columns()

    def run(self, chunk: Chunk) -> Rows:
        """Compute the rows of a chunk; see :class:`holdfast.core.sweeps.SweepJob`."""
        job, places = self.compiled_parts
        chunk_places = Places(places.poses[chunk.start : chunk.stop])
        beginnings = StartConfigurations(job.law, chunk_places, job.configurations, job.method, chunk.own_seed)
        return job.analyse(*beginnings.find_configurations(0, len(chunk)), len(chunk))
