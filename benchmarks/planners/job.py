"""Suite as combinations of a study: a task, with or without objects, and a planner; each row is a case."""

from __future__ import annotations

import json
import time
import zlib
from dataclasses import dataclass
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np
from benchmarks.planners import methods
from benchmarks.planners.cases import BenchmarkCase, CaseSampler
from benchmarks.planners.verdicts import find_violation
from numpy.typing import NDArray

from holdfast.core.sweeps.job import Chunk
from holdfast.core.sweeps.samples import Column
from holdfast.model.arms.serial import from_dict
from holdfast.model.collision.clearance_argument import decode_clearance
from holdfast.response.recovery.recovery import Answer
from holdfast.studies.study_files.jobs.process import PlannedJob

if TYPE_CHECKING:
    from holdfast.model.collision.shape import CollisionModel

Rows = dict[str, NDArray[Any]]
VERDICT_NAMES: tuple[Answer, ...] = ("solved", "proved infeasible", "argued infeasible", "undecided")
VIOLATION_NAMES = ("", "none", "start", "lock", "limits", "goal", "path", "contact", "kept")


def case_digest(case: BenchmarkCase) -> int:
    """Return a digest, 63 bits, of everything that defines a case."""
    text = json.dumps(case.to_dict(), sort_keys=True)
    return int.from_bytes(sha256(text.encode()).digest()[:8], "big") >> 1


@dataclass(frozen=True, eq=False)
class FailActiveJob(PlannedJob[CaseSampler]):
    """Cases of one task under one planner.

    Attributes:
        plan: Arm, cell, task, method, seconds.
        shape: Of the arm, which the capsules in the plan cover; None where they are the shape.
    """

    shape: CollisionModel | None = None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FailActiveJob) and other.plan == self.plan  # which has the digest of the shape

    __hash__ = PlannedJob.__hash__

    def compile_plan(self) -> CaseSampler:
        """Return the sampler of the cases with the objects to avoid."""
        arm = from_dict(self.plan["arm"])
        return CaseSampler(arm, decode_clearance(arm, self.plan, self.shape))

    def make_case(self, seed: int, row: int) -> BenchmarkCase:
        """Return a case by its number, which is the same for every planner and for any chunk size."""
        key = (zlib.crc32(str(self.plan["task"]).encode()), "cell" in self.plan, row)
        return self.compiled_parts.sample_case(
            self.plan["task"], np.random.default_rng(np.random.SeedSequence(seed, spawn_key=key))
        )

    def columns(self) -> list[Column]:
        """See :class:`holdfast.core.sweeps.SweepJob`."""
        verdicts = ", ".join(f"{code} {name}" for code, name in enumerate(VERDICT_NAMES))
        return [
            Column("case", "int64", (), units="1", about="digest of the case"),
            Column("joints", "uint8", (("kind", 3),), units="1", about="how many are locked, have a smaller range, are slower"),
            Column("verdict", "uint8", (), units="1", about=f"what the planner says: {verdicts}"),
            Column("trouble", "uint8", (), units="1", about=f"why the motion does not do the case: {VIOLATION_NAMES}"),
            Column("within", "uint8", (), units="1", about="1 where a proof holds for all that the judge accepts"),
            Column("seconds", "float64", (), units="s", about="measured, on one thread"),
            Column("processor", "float64", (), units="s", about="of the processor, in that time"),
            Column("travel", "float64", (), units="rad", about="length of the motion in joint space, 1 m as 1 rad"),
        ]

    def run(self, chunk: Chunk) -> Rows:
        """See :class:`holdfast.core.sweeps.SweepJob`."""
        sampler, method = self.compiled_parts, methods.PLANNERS_BY_NAME[self.plan["method"]]
        columns: dict[str, list[Any]] = {column.name: [] for column in self.columns()}
        for row in range(chunk.start, chunk.stop):
            case = self.make_case(chunk.seed, row)
            limit = methods.TimeLimit.start(self.plan["seconds"])
            processor_start = time.thread_time()
            attempt = method(case, sampler.clearance, limit, np.random.default_rng([chunk.seed, row]))
            columns["seconds"].append(time.perf_counter() - limit.started_at)
            columns["processor"].append(time.thread_time() - processor_start)
            columns["within"].append(attempt.within)
            solved, motion = attempt.verdict == "solved", attempt.motion
            columns["trouble"].append(
                VIOLATION_NAMES.index(find_violation(case, motion if solved else None, sampler.clearance))
            )
            columns["verdict"].append(VERDICT_NAMES.index(attempt.verdict))
            columns["case"].append(case_digest(case))
            failed = case.degraded
            columns["joints"].append([len(failed.locked), len(failed.ranges), len(failed.speeds)])
            travel = 0.0 if motion is None else float(np.linalg.norm(np.diff(motion.q, axis=0), axis=1).sum())
            columns["travel"].append(travel if solved else np.nan)
        return {definition.name: np.array(columns[definition.name], dtype=definition.dtype) for definition in self.columns()}
