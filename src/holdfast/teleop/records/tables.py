"""Records as tables, one row for each trial or each cycle, for analysis, R, JASP and spreadsheets."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.errors import HoldfastError
from holdfast.core.extras import import_extra
from holdfast.core.files.output import guard_writing, make_folder, replace_file
from holdfast.core.files.spreadsheet import write_csv_text
from holdfast.core.progress import reports_progress
from holdfast.core.typing import FloatArray
from holdfast.teleop.bank.tasks import TaskBank, drive_in_every_scenario
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import Subject, SubjectKind, TrialKind, TrialRecord
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import select_valid_trials
from holdfast.teleop.records.verification import require_undamaged_records
from holdfast.teleop.trials.driving import ComputerOperator, EndRules
from holdfast.teleop.trials.performance import PERFORMANCE_MEASURES, RECORDED_MEASURES, compute_measures
from holdfast.teleop.trials.recordings import End, Trials

if TYPE_CHECKING:
    import pandas as pd

    from holdfast.model.arm.model import Arm
    from holdfast.teleop.bank.selection import Binning


# _MAX_PATH_LENGTH_M and _PATIENCE_PATH_M: lengths of motion at full speed, m
_MAX_PATH_LENGTH_M = 50.0
_PATIENCE_PATH_M = 2.5
_STILL_FRACTION = 2e-5  # of the motion in a cycle at full speed

_TRIAL_COLUMNS = {
    "subject": ("", "code of the subject; no name"),
    "kind": ("", "person, simulated or computer"),
    "number": ("1", "running number of the subject, from 0"),
    "row": ("1", "row of the balanced square, from 0"),
    "position": ("1", "place of the trial in the session, from 1"),
    "task": ("1", "number of the task in the protocol, from 1; 0 in training"),
    "scenario": ("1", "number of the scenario, from 1; see protocol.yaml"),
    "law": ("", "control law"),
    "failed": ("", "the joint was locked at its start angle"),
    "joint": ("", "joint that the task has fail; empty for none"),
    "end": ("", "arrived, still, time, aborted or broken_off"),
    "cycles": ("1", "control cycles from start to end"),
    **{
        m.name: (m.unit, m.about + "; empty where the end effector did not reach the target")
        for m in PERFORMANCE_MEASURES[:RECORDED_MEASURES]
    },
    PERFORMANCE_MEASURES[RECORDED_MEASURES].name: ("1", "step of the rating, from 0; empty where there is none"),
    "began": ("", "UTC, ISO 8601"),
    "ended": ("", "UTC, ISO 8601; empty for a trial that was broken off"),
}
_CYCLE_COLUMNS = {
    "trial": ("1", "number of the trial in the records"),
    "k": ("1", "cycle, from 0; the last row of a trial is where the arm is at the end, without a command"),
    "time": ("s", "since the trial began, by the clock of who held the stick"),
}


def trial_table(records: Records, kinds: Sequence[TrialKind] = (TrialKind.TRIAL,)) -> pd.DataFrame:
    """Return a table with one row for each trial that was not repeated later.

    Args:
        records: Records of the experiment.
        kinds: Purposes of the trials that are included.

    Returns:
        Table with the columns of :func:`describe_columns`; measures have the units of
        :data:`holdfast.teleop.PERFORMANCE_MEASURES`.

    Raises:
        StoreError: The records are damaged: some content does not match its digest.
    """
    require_undamaged_records(records.folder)
    entries = [
        entry
        for subject in records.subjects()
        for kind in kinds
        for entry in select_valid_trials(records.entries(subject.code, kind))
    ]
    subjects = {subject.code: subject for subject in records.subjects()}
    return _build_trial_table(
        records.protocol,
        records.read_trials(entries),
        [_collect_trial_metadata(subjects[entry.subject], entry) for entry in entries],
    )


def computer_table(protocol: Protocol) -> pd.DataFrame:
    """Run the tasks of ``protocol`` under computer control in every scenario; return a row for each, as :func:`trial_table`."""
    facts = [
        {
            "subject": "computer",
            "kind": SubjectKind.COMPUTER.value,
            "number": -1,
            "row": -1,
            "position": 0,
            "task": task,
            "scenario": scenario,
        }
        for scenario in range(len(protocol.scenarios))
        for task in range(len(protocol.tasks))
    ]
    return _build_trial_table(protocol, run_computer_trials(protocol), facts)


@reports_progress("running the tasks")
def run_computer_trials(protocol: Protocol) -> Trials:
    """Run the protocol's tasks under computer control: scenario by scenario, in each all tasks.

    A trial ends after the time of 50 m at full speed, or when the end effector has been still for the time of 2.5 m: 1000 and
    50 of the paper's cycles.
    """
    limit = protocol.stick.limit
    rules = EndRules(
        radius=protocol.radius,
        cycle_limit=int(np.ceil(_MAX_PATH_LENGTH_M / limit)),
        still=_STILL_FRACTION * limit,
        patience=int(np.ceil(_PATIENCE_PATH_M / limit)),
    )
    return drive_in_every_scenario(
        protocol.plants, protocol.scenarios, protocol.tasks, ComputerOperator(), protocol.stick, rules
    )


def _collect_trial_metadata(subject: Subject, entry: TrialRecord) -> dict[str, Any]:
    return {
        "subject": subject.code,
        "kind": subject.kind.value,
        "number": subject.number,
        "row": subject.row,
        "position": entry.position + 1,
        "task": entry.task,
        "scenario": entry.scenario,
        "M12": np.nan if entry.rating is None else float(entry.rating),
        "began": entry.began,
        "ended": entry.ended or "",
    }


def _build_trial_table(protocol: Protocol, trials: Trials, trial_metadata: list[dict[str, Any]]) -> pd.DataFrame:
    pd = import_extra("pandas", "stats")

    table = pd.DataFrame(
        trial_metadata, columns=[column for column in _TRIAL_COLUMNS if not trial_metadata or column in trial_metadata[0]]
    )
    scenario, task = table["scenario"].to_numpy(dtype=np.int64), table["task"].to_numpy(dtype=np.int64)
    joint_names = (*protocol.arm.joint_names, "")
    table["task"], table["scenario"] = task + 1, scenario + 1
    table["law"] = [protocol.scenarios[scenario_index].law for scenario_index in scenario]
    table["failed"] = [protocol.scenarios[scenario_index].failed for scenario_index in scenario]
    table["joint"] = [joint_names[protocol.tasks.joint[task_index]] if task_index >= 0 else "" for task_index in task]
    table["end"] = [End(end).name.lower() for end in trials.end]
    table["cycles"] = trials.cycles
    for measure, values in zip(PERFORMANCE_MEASURES[:RECORDED_MEASURES], compute_measures(trials).T, strict=True):
        table[measure.name] = values
    if "M12" not in table:
        table["M12"] = np.nan
    return table[[column for column in _TRIAL_COLUMNS if column in table]]


def bank_table(bank: TaskBank, arm: Arm, cells: Binning | None = None) -> pd.DataFrame:
    """Return a table with one row for each task of a bank, with every measure and CPM in every scenario.

    Args:
        bank: N tasks with the trials of the computer.
        arm: Arm of the tasks.
        cells: Cells of the tasks, which add a column with the cell, from 0; -1 where a scenario was not completed.

    Returns:
        ``task`` (from 1), ``joint`` (that fails; empty for none), the start (joint names, rad and m), the target (``target_x``
        and so on, m), then for each scenario with its number k: ``end_k``, ``M1_k`` to ``M11_k``, ``cpm_k``; empty where the
        end effector did not reach the target.
    """
    pd = import_extra("pandas", "stats")

    tasks, joint_names = bank.tasks, (*arm.joint_names, "")
    columns: dict[str, Any] = {
        "task": np.arange(len(bank)) + 1,
        "joint": [joint_names[joint] for joint in tasks.joint],
        **dict(zip(arm.joint_names, tasks.q0.T, strict=True)),
        **{f"target_{_axis_name(axis, tasks.target.shape[1])}": column for axis, column in enumerate(tasks.target.T)},
    }
    for index, scenario in enumerate(bank.scenarios):
        columns[f"end_{scenario.number}"] = [End(end).name.lower() for end in bank.end[index]]
        for measure, values in zip(PERFORMANCE_MEASURES[:RECORDED_MEASURES], bank.measures[index].T, strict=True):
            columns[f"{measure.name}_{scenario.number}"] = values
        columns[f"cpm_{scenario.number}"] = bank.cpm[index]
    if cells is not None:
        columns["cell"] = cells.cell
    return pd.DataFrame(columns)


def tool_paths(records: Records) -> Callable[[str | None, int, int], FloatArray | None]:
    """Return a function for the tool path of a trial in ``records``, for :meth:`holdfast.teleop.analysis.Analysis.report`.

    Returns:
        Function of a subject's code (None means the computer) and the numbers of a task and a scenario (from 1). It returns
        (K, m) tool points, m, or None if no such trial was recorded.
    """
    protocol = records.protocol
    by_computer = run_computer_trials(protocol)

    def find_path(subject: str | None, task: int, scenario: int) -> FloatArray | None:
        if subject is None:
            return by_computer.path((scenario - 1) * len(protocol.tasks) + task - 1)
        for entry in select_valid_trials(records.entries(subject, TrialKind.TRIAL)):
            if (entry.task, entry.scenario) == (task - 1, scenario - 1):
                return records.read_trials([entry]).path(0)
        return None

    return find_path


@reports_progress("reading the records")
def cycle_table(records: Records) -> pd.DataFrame:
    """Return a table with one row for each cycle of every trial in ``records``, and one for each final configuration.

    Raises:
        StoreError: The records are damaged: some content does not match its digest.
    """
    require_undamaged_records(records.folder)
    return _build_cycle_table(records)


def _build_cycle_table(records: Records) -> pd.DataFrame:
    pd = import_extra("pandas", "stats")

    protocol = records.protocol
    entries = records.entries()
    recorded = records.read_cycles(entries)
    rows = np.diff(recorded.first)
    table = pd.DataFrame(
        np.column_stack([recorded.time, recorded.velocity, recorded.q, protocol.plants[0].position(recorded.q)]),
        columns=[*list(_CYCLE_COLUMNS)[2:], *_describe_cycle_columns(protocol)],
    )
    table.insert(0, "trial", np.repeat(np.array([e.id for e in entries], dtype=np.int64), rows))
    table.insert(1, "k", np.arange(len(recorded.q)) - np.repeat(recorded.first[:-1], rows))
    return table


def _describe_cycle_columns(protocol: Protocol) -> dict[str, tuple[str, str]]:
    arm, m = protocol.arm, protocol.rows.m
    units = ["m" if is_prismatic else "rad" for is_prismatic in arm.prismatic]
    return {
        **{f"v{_axis_name(axis, m)}": ("m/cycle", "commanded velocity") for axis in range(m)},
        **{name: (unit, "joint when the cycle began") for name, unit in zip(arm.joint_names, units, strict=True)},
        **{_axis_name(axis, m): ("m", "tool point when the cycle began") for axis in range(m)},
    }


def _axis_name(axis: int, axis_count: int) -> str:
    return "xyz"[axis] if axis_count <= 3 else str(axis + 1)


def describe_columns(protocol: Protocol) -> pd.DataFrame:
    """Return a table that describes every column of the tables of ``protocol``: table, column, unit, description."""
    pd = import_extra("pandas", "stats")

    rows = [("trials", name, *description) for name, description in _TRIAL_COLUMNS.items()]
    rows += [
        ("cycles", name, *description) for name, description in {**_CYCLE_COLUMNS, **_describe_cycle_columns(protocol)}.items()
    ]
    return pd.DataFrame(rows, columns=["table", "column", "unit", "description"])


@reports_progress("writing the tables")
def export_tables(records: Records, folder: str | Path, parquet: bool = False) -> list[Path]:
    """Write ``trials``, ``cycles``, ``subjects`` and ``events``, with ``dictionary.csv`` and the protocol.

    Args:
        records: Records of the experiment.
        folder: Output folder, created if necessary; existing files of these names are replaced.
        parquet: Write Parquet instead of CSV for the four tables.

    Returns:
        Paths of the files.

    Raises:
        HoldfastError: pandas is not installed, or ``parquet`` is true and pyarrow is not installed.
        StoreError: The records are damaged, or a file cannot be written.
    """
    pd = import_extra("pandas", "stats")

    if parquet:
        try:
            import pyarrow  # noqa: F401
        except ModuleNotFoundError:
            raise HoldfastError("Parquet needs pyarrow; install 'holdfast-arms[parquet]', or export CSV") from None
    subjects = [
        {
            "subject": subject.code,
            "kind": subject.kind.value,
            "number": subject.number,
            "row": subject.row,
            "state": subject.state.value,
            "since": subject.since,
        }
        | {"note": subject.note}
        | {f"answer {key}": value for key, value in subject.answers.items()}
        for subject in records.subjects()
    ]
    events = [
        {**event, "data": json.dumps(event["data"], ensure_ascii=False) if event["data"] else ""} for event in records.events()
    ]
    tables = {
        "trials": trial_table(records, (TrialKind.TRAINING, TrialKind.TRIAL)),
        "cycles": _build_cycle_table(records),
        "subjects": pd.DataFrame(subjects),
        "events": pd.DataFrame(events),
    }
    path = make_folder(folder)
    written = []
    for name, table in tables.items():
        file = path / f"{name}.{'parquet' if parquet else 'csv'}"
        if parquet:
            with guard_writing(path):
                table.to_parquet(file, index=False)
        else:
            replace_file(file, write_csv_text(table))
        written.append(file)
    file = path / "dictionary.csv"
    replace_file(file, write_csv_text(describe_columns(records.protocol)))
    return [*written, file, records.protocol.write(path / "protocol.yaml")]
