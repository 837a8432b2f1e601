"""The suite as cells of a study: a task, in a cell or not, under a planner; a row is a case."""

from __future__ import annotations

import json
import time
import zlib
from dataclasses import dataclass
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.arms.serial import from_dict
from holdfast.bench import methods
from holdfast.bench.cases import Case, Draw
from holdfast.bench.judge import trouble
from holdfast.clearance.choice import from_stored
from holdfast.engine.job import Chunk
from holdfast.engine.store import Column
from holdfast.recovery.recovery import Answer
from holdfast.studies.jobs.process import PlannedJob

if TYPE_CHECKING:
    from holdfast.clearance.shape import Shape

Rows = dict[str, NDArray[Any]]
VERDICTS: tuple[Answer, ...] = ("solved", "proved infeasible", "argued infeasible", "undecided")
TROUBLES = ("", "none", "start", "lock", "limits", "goal", "path", "contact", "kept")


def digest(case: Case) -> int:
    """Of all that defines a case: 63 bits."""
    text = json.dumps(case.to_dict(), sort_keys=True)
    return int.from_bytes(sha256(text.encode()).digest()[:8], "big") >> 1


@dataclass(frozen=True, eq=False)
class FailActiveJob(PlannedJob[Draw]):
    """Cases of one task under one planner.

    Attributes:
        plan: Arm, cell, task, method, seconds.
        shape: Of the arm, which the capsules in the plan cover; None where they are the shape.
    """

    shape: Shape | None = None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FailActiveJob) and other.plan == self.plan  # which has the digest of the shape

    __hash__ = PlannedJob.__hash__

    def compiled(self) -> Draw:
        """What draws the cases, with what must be kept clear."""
        arm = from_dict(self.plan["arm"])
        return Draw(arm, from_stored(arm, self.plan, self.shape))

    def case(self, seed: int, row: int) -> Case:
        """A case by its number: the same for every planner, whatever the chunks are."""
        key = (zlib.crc32(str(self.plan["task"]).encode()), "cell" in self.plan, row)
        return self.made.case(self.plan["task"], np.random.default_rng(np.random.SeedSequence(seed, spawn_key=key)))

    def columns(self) -> list[Column]:
        """See :class:`holdfast.engine.Job`."""
        verdicts = ", ".join(f"{k} {name}" for k, name in enumerate(VERDICTS))
        return [
            Column("case", "int64", (), units="1", about="digest of the case"),
            Column("joints", "uint8", (("kind", 3),), units="1", about="how many are locked, have a smaller range, are slower"),
            Column("verdict", "uint8", (), units="1", about=f"what the planner says: {verdicts}"),
            Column("trouble", "uint8", (), units="1", about=f"why the motion does not do the case: {TROUBLES}"),
            Column("within", "uint8", (), units="1", about="1 where a proof holds for all that the judge accepts"),
            Column("seconds", "float64", (), units="s", about="measured, on one thread"),
            Column("processor", "float64", (), units="s", about="of the processor, in that time"),
            Column("travel", "float64", (), units="rad", about="length of the motion in joint space, 1 m as 1 rad"),
        ]

    def run(self, chunk: Chunk) -> Rows:
        """See :class:`holdfast.engine.Job`."""
        draw, method = self.made, methods.METHODS[self.plan["method"]]
        found: dict[str, list[Any]] = {column.name: [] for column in self.columns()}
        for row in range(chunk.start, chunk.stop):
            case = self.case(chunk.seed, row)
            limit = methods.Limit.of(self.plan["seconds"])
            busy = time.thread_time()
            attempt = method(case, draw.clearance, limit, np.random.default_rng([chunk.seed, row]))
            found["seconds"].append(time.perf_counter() - limit.begin)
            found["processor"].append(time.thread_time() - busy)
            found["within"].append(attempt.within)
            solved, motion = attempt.verdict == "solved", attempt.motion
            found["trouble"].append(TROUBLES.index(trouble(case, motion if solved else None, draw.clearance)))
            found["verdict"].append(VERDICTS.index(attempt.verdict))
            found["case"].append(digest(case))
            d = case.degraded
            found["joints"].append([len(d.locked), len(d.ranges), len(d.speeds)])
            moved = 0.0 if motion is None else float(np.linalg.norm(np.diff(motion.q, axis=0), axis=1).sum())
            found["travel"].append(moved if solved else np.nan)
        return {c.name: np.array(found[c.name], dtype=c.dtype) for c in self.columns()}
