"""Run the whole suite into a folder, and summarize the results."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.planners import methods
from benchmarks.planners.cases import CASE_MAKERS
from benchmarks.planners.job import VERDICT_NAMES, FailActiveJob, case_digest
from numpy.typing import NDArray

from holdfast.core import registry
from holdfast.core.errors import InputError, StoreError
from holdfast.core.files.output import replace_file
from holdfast.core.probability import Interval
from holdfast.core.sweeps import Runner, Study, SweepCell, ThreadRunner
from holdfast.core.sweeps.runner import Stop
from holdfast.core.sweeps.work import Progress
from holdfast.core.validation import check_arguments
from holdfast.model.arm import Arm
from holdfast.model.arms.serial import to_dict
from holdfast.model.cell import Cell, as_cell
from holdfast.model.collision import chosen_clearance
from holdfast.model.collision.clearance_argument import CellLike, encode_clearance
from holdfast.studies.study_files.results import read_chunks

Rows = dict[str, NDArray[Any]]

SUITE_NAME = "fail-active"
PATH_CASE_DIVISOR = 10  # how many times fewer cases there are of tasks that are no reach, as in the suite of the specification


@dataclass(frozen=True, kw_only=True)
class Score:
    """Results of one planner for the cases of a task.

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
        """Fraction of all cases that are solved, with its Clopper-Pearson interval."""
        return Interval.from_counts(self.solved, self.cases)

    @property
    def success_of_feasible(self) -> Interval | None:
        """Fraction of the cases that are not proved infeasible; None if all are."""
        return Interval.from_counts(self.solved, self.feasible) if self.feasible else None

    @property
    def decided_fraction(self) -> Interval:
        """Fraction of the cases that are solved or proved infeasible."""
        return Interval.from_counts(self.solved + self.proved, self.cases)


class FailActive:
    """Results of the suite so far; see :func:`fail_active`.

    Attributes:
        study: Its folder.
        scores: One for each task and method that has cases, in the order of the suite.
    """

    def __init__(self, study: Study) -> None:
        self.study = study
        rows = {index: _read_rows(study, index) for index in range(len(study.cells))}
        labels = [study_cell["labels"] for study_cell in study.cells]
        if any(label.get("job") != SUITE_NAME for label in labels):
            raise StoreError(f"'{study.path}' is not a suite; give the folder that 'python -m benchmarks.planners --out' wrote")
        proofs = {
            (label["task"], label["around"]): _proved_infeasible_cases(rows[index])
            for index, label in enumerate(labels)
            if label["method"] == "recover" and rows[index]
        }
        self.scores = tuple(
            _make_score(label, rows[index], proofs.get((label["task"], label["around"]), set()))
            for index, label in enumerate(labels)
            if rows[index]
        )

    @property
    def complete(self) -> bool:
        """True if every case is done."""
        return self.study.is_complete

    def describe(self) -> list[str]:
        """Describe the results of each task and method in one sentence."""
        lines = self.study.describe()
        for score in self.scores:
            place = "in its cell" if score.in_cell else "without a cell"
            lines.append(
                f"{score.task} {place}, {score.method}: {score.solved} of {score.cases} solved, {score.proved} proved "
                f"infeasible, {score.argued} "
                f"argued infeasible, {score.undecided} undecided; median {np.median(score.seconds):.2g} s"
            )
        return lines


def _read_rows(study: Study, cell: int) -> Rows:
    parts = list(read_chunks(study, cell))
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]} if parts else {}


def _proved_infeasible_cases(rows: Rows) -> set[int]:
    return set(rows["case"][(rows["verdict"] == VERDICT_NAMES.index("proved infeasible")) & (rows["within"] == 1)].tolist())


def _make_score(label: dict[str, Any], rows: Rows, proofs: set[int]) -> Score:
    verdict = rows["verdict"]
    is_solved = (verdict == 0) & (rows["trouble"] == 0)
    infeasible = np.isin(rows["case"], list(proofs))
    _, proved, argued, _ = (int(np.count_nonzero(verdict == code)) for code in range(len(VERDICT_NAMES)))
    refused = int(np.count_nonzero((verdict == 0) & ~is_solved))
    solved, cases = int(np.count_nonzero(is_solved)), len(verdict)
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
        contradictions=int(np.count_nonzero(is_solved & infeasible)),
        seconds=rows["seconds"],
        processor=rows["processor"],
    )


@check_arguments
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
    """Sample failures and tasks, and count the cases that each planner solves; the same call resumes.

    Args:
        arm: The arm.
        out: Folder of the study, whose cases are written to ``cases.jsonl``.
        cell: Objects around the arm, or their file; every task is then done in it and without it.
        cases: Of each task that reaches a pose; of the others a tenth.
        tasks: Some of ``benchmarks.planners.cases.CASE_MAKERS``; all if not given.
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
    chosen = list(CASE_MAKERS) if tasks is None else list(tasks)
    for kind, names, known_names in (("task", chosen, CASE_MAKERS), ("planner", planners, methods.PLANNERS_BY_NAME)):
        for name in names:
            if name not in known_names:
                raise InputError(registry.unknown_name_message(kind, name, known_names))
    for name in planners:
        methods.require_installed(name)
    work_cell = as_cell(cell)
    cells = [
        _study_cell(arm, case_cell, task, method, cases, seconds)
        for case_cell in ([None] if work_cell is None else [None, work_cell])
        for task in chosen
        for method in planners
        if methods.is_applicable(method, task)
    ]
    study = Study.create(out, SUITE_NAME, seed, cells=cells)
    _write_cases(study, cells, seed)
    problems = study.run(cells, ThreadRunner(1) if runner is None else runner, progress, stop=stop)
    for problem in problems.values():
        raise problem
    return FailActive(study)


def _study_cell(arm: Arm, work_cell: Cell | None, task: str, method: str, cases: int, seconds: float) -> SweepCell:
    clearance = chosen_clearance(arm, None, work_cell)
    shape = None if clearance is None else clearance.capsules.shape
    plan = {
        "kind": SUITE_NAME,
        "fingerprint": arm.fingerprint,
        "arm": to_dict(arm),
        "task": task,
        "method": method,
        "seconds": seconds,
        **({} if clearance is None else encode_clearance(clearance)),
        **({} if shape is None else {"shape": shape.digest}),
    }
    labels = {
        "job": SUITE_NAME,
        "arm": arm.name,
        "task": task,
        "method": method,
        "around": "" if work_cell is None else work_cell.name,
    }
    rows = cases if task.startswith("reach") else max(cases // PATH_CASE_DIVISOR, 1)
    name = "-".join([task, method, *(["cell"] if work_cell is not None else [])])
    return SweepCell(name, FailActiveJob(plan, shape), plan, rows=rows, chunk=min(rows, 5), labels=labels)


def _write_cases(study: Study, cells: Sequence[SweepCell], seed: int) -> None:
    """Write every case, one JSON object per line, for other planners."""
    file = study.path / "cases.jsonl"
    if file.exists():
        return
    lines, written = [], set()
    for cell in cells:
        job = cell.job
        assert isinstance(job, FailActiveJob)
        key = (job.plan["task"], cell.labels["around"])
        if key in written:
            continue
        written.add(key)
        for row in range(cell.rows):
            case = job.make_case(seed, row)
            lines.append(
                json.dumps(
                    {"number": row, "cell": cell.labels["around"], "digest": f"{case_digest(case):016x}", **case.to_dict()}
                )
            )
    replace_file(file, "\n".join(lines) + "\n")
