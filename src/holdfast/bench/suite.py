"""The suite as a whole: run into a folder, and what it found."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from holdfast import registry
from holdfast.arguments import checked
from holdfast.arm.model import Arm
from holdfast.arms.serial import to_dict
from holdfast.bench import methods
from holdfast.bench.cases import TASKS
from holdfast.bench.job import VERDICTS, FailActiveJob, digest
from holdfast.cell.cell import Cell, as_cell
from holdfast.clearance.choice import CellLike, chosen_clearance, stored
from holdfast.engine.job import Cell as StudyCell
from holdfast.engine.runner import Runner, Stop, Threads
from holdfast.engine.study import Study
from holdfast.engine.work import Progress
from holdfast.errors import InputError, StoreError
from holdfast.files.output import replaced
from holdfast.probability.intervals import Interval
from holdfast.result import Result
from holdfast.studies.results import chunks

Rows = dict[str, NDArray[Any]]

NAME = "fail-active"
FEWER = 10  # how many times fewer cases there are of tasks that are no reach, as in the suite of the specification


@dataclass(frozen=True, kw_only=True)
class Score:
    """What a planner did with the cases of a task.

    Attributes:
        task, method: Their names.
        in_cell: Objects are around the arm.
        cases: How many there are so far.
        solved: By a motion that the judge accepts.
        refused: Motions that the judge does not accept.
        proved, argued: Cases that the planner says are infeasible, with a proof or without.
        within: Of the proofs, those that hold for all that the judge accepts, not for the exact poses alone.
        undecided: The others.
        feasible: Cases that :func:`holdfast.recover` did not prove infeasible within what the judge accepts, of those that it
            was asked too.
        contradictions: Cases solved that it did.
        seconds: (cases,) measured.
        processor: (cases,) s of the processor in that time; less where others used it too.
    """

    task: str
    method: str
    in_cell: bool
    cases: int
    solved: int
    refused: int
    proved: int
    within: int
    argued: int
    undecided: int
    feasible: int
    contradictions: int
    seconds: NDArray[np.float64]
    processor: NDArray[np.float64]

    @property
    def success(self) -> Interval:
        """Share of all cases that are solved, with its exact interval."""
        return Interval.of(self.solved, self.cases)

    @property
    def success_of_feasible(self) -> Interval | None:
        """Share of the cases that are not proved infeasible; None if all are."""
        return Interval.of(self.solved, self.feasible) if self.feasible else None

    @property
    def decided(self) -> Interval:
        """Share of the cases that are solved or proved infeasible."""
        return Interval.of(self.solved + self.proved, self.cases)


class FailActive(Result):
    """What the suite found so far; see :func:`fail_active`.

    Attributes:
        study: Its folder.
        scores: One for each task and method that has cases, in the order of the suite.
    """

    def __init__(self, study: Study) -> None:
        self.study = study
        rows = {k: _rows(study, k) for k in range(len(study.cells))}
        labels = [c["labels"] for c in study.cells]
        if any(label.get("job") != NAME for label in labels):
            raise StoreError(f"'{study.path}' is not a suite; give the folder that 'holdfast bench {NAME} --out' wrote")
        proofs = {
            (label["task"], label["around"]): _proofs(rows[k])
            for k, label in enumerate(labels)
            if label["method"] == "recover" and rows[k]
        }
        self.scores = tuple(
            _score(label, rows[k], proofs.get((label["task"], label["around"]), set()))
            for k, label in enumerate(labels)
            if rows[k]
        )

    @property
    def complete(self) -> bool:
        """Every case is done."""
        return self.study.complete

    def describe(self) -> list[str]:
        """A sentence a task and method."""
        lines = self.study.describe()
        for s in self.scores:
            where = "in its cell" if s.in_cell else "without a cell"
            lines.append(
                f"{s.task} {where}, {s.method}: {s.solved} of {s.cases} solved, {s.proved} proved infeasible, {s.argued} "
                f"argued infeasible, {s.undecided} undecided; median {np.median(s.seconds):.2g} s"
            )
        return lines


def _rows(study: Study, cell: int) -> Rows:
    parts = list(chunks(study, cell))
    return {name: np.concatenate([p[name] for p in parts]) for name in parts[0]} if parts else {}


def _proofs(rows: Rows) -> set[int]:
    return set(rows["case"][(rows["verdict"] == VERDICTS.index("proved infeasible")) & (rows["within"] == 1)].tolist())


def _score(label: dict[str, Any], rows: Rows, proofs: set[int]) -> Score:
    verdict = rows["verdict"]
    good = (verdict == 0) & (rows["trouble"] == 0)
    infeasible = np.isin(rows["case"], list(proofs))
    _, proved, argued, _ = (int(np.count_nonzero(verdict == k)) for k in range(len(VERDICTS)))
    refused = int(np.count_nonzero((verdict == 0) & ~good))
    solved, cases = int(np.count_nonzero(good)), len(verdict)
    return Score(
        task=label["task"],
        method=label["method"],
        in_cell=label["around"] != "",
        cases=cases,
        solved=solved,
        refused=refused,
        proved=proved,
        within=int(np.count_nonzero((verdict == 1) & (rows["within"] == 1))),
        argued=argued,
        undecided=cases - solved - refused - proved - argued,
        feasible=int(np.count_nonzero(~infeasible)),
        contradictions=int(np.count_nonzero(good & infeasible)),
        seconds=rows["seconds"],
        processor=rows["processor"],
    )


@checked
def fail_active(
    arm: Arm,
    out: str | Path,
    *,
    cell: CellLike | None = None,
    cases: int = 1000,
    tasks: Sequence[str] | None = None,
    planners: Sequence[str] = ("recover",),
    seconds: float = 10.0,
    seed: int = 1,
    runner: Runner | None = None,
    progress: Progress | None = None,
    stop: Stop = lambda: False,
) -> FailActive:
    """Draw failures and tasks, and count what each planner finishes; the same call resumes.

    Args:
        arm: The arm.
        out: Folder of the study, whose cases are written to ``cases.jsonl``.
        cell: Objects around the arm, or their file; every task is then done in it and without it.
        cases: Of each task that reaches a pose; of the others a tenth.
        tasks: Some of ``holdfast.bench.cases.TASKS``; all if not given.
        planners: Some of ``recover``, ``differential-ik``, ``differential-ik-8-starts``, ``rrt-connect`` and
            ``ompl-rrt-connect`` (needs OMPL). The last two are asked to reach poses alone.
        seconds: Time limit of a case, on one thread.
        seed: The same seed gives the same cases, whatever the planners.
        runner: Who computes; one thread if not given, as times are measured.
        progress: Called after every chunk.
        stop: Asked now and then; once it says True, what is at work is finished and no more begun.

    Raises:
        InputError: An unknown task or planner, or a number that is too small.
        HoldfastError: A planner needs a package that is not installed, or no case can be drawn.
        StoreError: The folder holds something else, or cannot be written.
    """
    if cases < 1 or not seconds > 0:
        raise InputError(f"cases is {cases} and seconds {seconds:g}; give 1 or more, and a time above 0")
    chosen = list(TASKS) if tasks is None else list(tasks)
    for kind, names, known in (("task", chosen, TASKS), ("planner", planners, methods.METHODS)):
        for name in names:
            if name not in known:
                raise InputError(registry.unknown(kind, name, known))
    for name in planners:
        methods.require(name)
    around = as_cell(cell)
    cells = [
        _cell(arm, place, task, method, cases, seconds)
        for place in ([None] if around is None else [None, around])
        for task in chosen
        for method in planners
        if methods.usable(method, task)
    ]
    study = Study.create(out, NAME, seed, cells=cells)
    _write_cases(study, cells, seed)
    problems = study.run(cells, Threads(1) if runner is None else runner, progress, stop=stop)
    for problem in problems.values():
        raise problem
    return FailActive(study)


def _cell(arm: Arm, around: Cell | None, task: str, method: str, cases: int, seconds: float) -> StudyCell:
    clearance = chosen_clearance(arm, None, around)
    shape = None if clearance is None else clearance.capsules.shape
    plan = {
        "kind": NAME,
        "fingerprint": arm.fingerprint,
        "arm": to_dict(arm),
        "task": task,
        "method": method,
        "seconds": seconds,
        **({} if clearance is None else stored(clearance)),
        **({} if shape is None else {"shape": shape.digest}),
    }
    labels = {"job": NAME, "arm": arm.name, "task": task, "method": method, "around": "" if around is None else around.name}
    rows = cases if task.startswith("reach") else max(cases // FEWER, 1)
    name = "-".join([task, method, *(["cell"] if around is not None else [])])
    return StudyCell(name, FailActiveJob(plan, shape), plan, rows=rows, chunk=min(rows, 5), labels=labels)


def _write_cases(study: Study, cells: Sequence[StudyCell], seed: int) -> None:
    """Every case, one JSON object a line, for others to try."""
    file = study.path / "cases.jsonl"
    if file.exists():
        return
    lines, seen = [], set()
    for cell in cells:
        job = cell.job
        assert isinstance(job, FailActiveJob)
        key = (job.plan["task"], cell.labels["around"])
        if key in seen:
            continue
        seen.add(key)
        for row in range(cell.rows):
            case = job.case(seed, row)
            lines.append(
                json.dumps({"number": row, "cell": cell.labels["around"], "digest": f"{digest(case):016x}", **case.to_dict()})
            )
    replaced(file, "\n".join(lines) + "\n")
