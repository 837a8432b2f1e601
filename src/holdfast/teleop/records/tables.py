"""The records as tables: one row for each trial, one for each cycle; for analysis, and for R, JASP and spreadsheets."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import HoldfastError
from holdfast.files.output import guarded, made, replaced
from holdfast.files.spreadsheet import csv_text
from holdfast.notice import says
from holdfast.teleop.bank.tasks import TaskBank, in_every_scenario
from holdfast.teleop.protocol.protocol import Protocol
from holdfast.teleop.records.entries import Entry, Kind, Subject, Who
from holdfast.teleop.records.records import Records
from holdfast.teleop.records.session import done
from holdfast.teleop.records.verification import refuse_damage
from holdfast.teleop.trials.driving import Computer, Rules
from holdfast.teleop.trials.performance import MEASURES, RECORDED, measures
from holdfast.teleop.trials.recordings import End, Trials

if TYPE_CHECKING:
    import pandas as pd

    from holdfast.arm.model import Arm
    from holdfast.teleop.bank.selection import Binning

Array = NDArray[np.float64]

_FARTHEST, _PATIENCE = 50.0, 2.5  # m
_STILL = 2e-5  # of a cycle's way at full speed

_COLUMNS = {
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
    **{m.name: (m.unit, m.about + "; empty where the end effector did not reach the target") for m in MEASURES[:RECORDED]},
    MEASURES[RECORDED].name: ("1", "step of the rating, from 0; empty where there is none"),
    "began": ("", "UTC, ISO 8601"),
    "ended": ("", "UTC, ISO 8601; empty for a trial that was broken off"),
}
_CYCLE_COLUMNS = {
    "trial": ("1", "number of the trial in the records"),
    "k": ("1", "cycle, from 0; the last row of a trial is where the arm is at the end, without a command"),
    "time": ("s", "since the trial began, by the clock of who held the stick"),
}


def trial_table(records: Records, kinds: Sequence[Kind] = (Kind.TRIAL,)) -> pd.DataFrame:
    """One row for each trial that was not done again later.

    Args:
        records: The records.
        kinds: Which trials: those that count, or training too.

    Returns:
        A table with the columns that :func:`dictionary` describes; measures in the units of
        :data:`holdfast.teleop.MEASURES`.

    Raises:
        StoreError: The records are damaged: something in them does not match its digest.
    """
    refuse_damage(records.folder)
    entries = [e for s in records.subjects() for kind in kinds for e in done(records.entries(s.code, kind))]
    subjects = {s.code: s for s in records.subjects()}
    return _table(records.protocol, records.trials(entries), [_facts(subjects[e.subject], e) for e in entries])


def computer_table(protocol: Protocol) -> pd.DataFrame:
    """The protocol's tasks under computer control, in every scenario: one row for each, as :func:`trial_table`."""
    facts = [
        {"subject": "computer", "kind": Who.COMPUTER.value, "number": -1, "row": -1, "position": 0, "task": t, "scenario": s}
        for s in range(len(protocol.scenarios))
        for t in range(len(protocol.tasks))
    ]
    return _table(protocol, computer_trials(protocol), facts)


@says("running the tasks")
def computer_trials(protocol: Protocol) -> Trials:
    """The protocol's tasks under computer control: scenario by scenario, in each all tasks.

    A trial is over after the time of 50 m at full speed, or when the end effector has been still for that of 2.5 m: 1000 and 50
    of the paper's cycles.
    """
    limit = protocol.stick.limit
    rules = Rules(
        radius=protocol.radius,
        cycle_limit=int(np.ceil(_FARTHEST / limit)),
        still=_STILL * limit,
        patience=int(np.ceil(_PATIENCE / limit)),
    )
    return in_every_scenario(protocol.plants, protocol.scenarios, protocol.tasks, Computer(), protocol.stick, rules)


def _facts(subject: Subject, entry: Entry) -> dict[str, Any]:
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


def _table(protocol: Protocol, trials: Trials, facts: list[dict[str, Any]]) -> pd.DataFrame:
    import pandas as pd

    table = pd.DataFrame(facts, columns=[c for c in _COLUMNS if not facts or c in facts[0]])
    scenario, task = table["scenario"].to_numpy(dtype=np.int64), table["task"].to_numpy(dtype=np.int64)
    names = (*protocol.arm.joint_names, "")
    table["task"], table["scenario"] = task + 1, scenario + 1
    table["law"] = [protocol.scenarios[s].law for s in scenario]
    table["failed"] = [protocol.scenarios[s].failed for s in scenario]
    table["joint"] = [names[protocol.tasks.joint[t]] if t >= 0 else "" for t in task]
    table["end"] = [End(e).name.lower() for e in trials.end]
    table["cycles"] = trials.cycles
    for measure, values in zip(MEASURES[:RECORDED], measures(trials).T, strict=True):
        table[measure.name] = values
    if "M12" not in table:
        table["M12"] = np.nan
    return table[[c for c in _COLUMNS if c in table]]


def bank_table(bank: TaskBank, arm: Arm, cells: Binning | None = None) -> pd.DataFrame:
    """One row for each task of a bank, with every measure and CPM in every scenario.

    Args:
        bank: N tasks as the computer did them.
        arm: Whose tasks they are.
        cells: Adds the cell of each task, from 0; -1 where a scenario was not completed.

    Returns:
        ``task`` (from 1), ``joint`` (that fails; empty for none), the start (joint names, rad and m), the target (``target_x``
        and so on, m), then for each scenario its number k: ``end_k``, ``M1_k`` to ``M11_k``, ``cpm_k``; empty where
        the end effector
        did not reach it.
    """
    import pandas as pd

    tasks, names = bank.tasks, (*arm.joint_names, "")
    columns: dict[str, Any] = {
        "task": np.arange(len(bank)) + 1,
        "joint": [names[j] for j in tasks.joint],
        **dict(zip(arm.joint_names, tasks.q0.T, strict=True)),
        **{f"target_{_axis(k, tasks.target.shape[1])}": column for k, column in enumerate(tasks.target.T)},
    }
    for s, scenario in enumerate(bank.scenarios):
        columns[f"end_{scenario.number}"] = [End(e).name.lower() for e in bank.end[s]]
        for measure, values in zip(MEASURES[:RECORDED], bank.measures[s].T, strict=True):
            columns[f"{measure.name}_{scenario.number}"] = values
        columns[f"cpm_{scenario.number}"] = bank.cpm[s]
    if cells is not None:
        columns["cell"] = cells.cell
    return pd.DataFrame(columns)


def tool_paths(records: Records) -> Callable[[str | None, int, int], Array | None]:
    """Where the end effector was in a trial, as a function that :meth:`holdfast.teleop.analysis.Analysis.report` takes.

    Returns:
        From a subject's code (None means the computer), a task's and a scenario's number (from 1) it makes (K, m) tool points,
        m, or None where no such trial was recorded.
    """
    protocol = records.protocol
    by_computer = computer_trials(protocol)

    def path(subject: str | None, task: int, scenario: int) -> Array | None:
        if subject is None:
            return by_computer.path((scenario - 1) * len(protocol.tasks) + task - 1)
        for e in done(records.entries(subject, Kind.TRIAL)):
            if (e.task, e.scenario) == (task - 1, scenario - 1):
                return records.trials([e]).path(0)
        return None

    return path


@says("reading the records")
def cycle_table(records: Records) -> pd.DataFrame:
    """One row for each cycle of every trial, with one more for where the arm was at the end.

    Raises:
        StoreError: The records are damaged: something in them does not match its digest.
    """
    refuse_damage(records.folder)
    return _cycles(records)


def _cycles(records: Records) -> pd.DataFrame:
    import pandas as pd

    protocol = records.protocol
    entries = records.entries()
    recorded = records.recorded(entries)
    rows = np.diff(recorded.first)
    table = pd.DataFrame(
        np.column_stack([recorded.time, recorded.velocity, recorded.q, protocol.plants[0].position(recorded.q)]),
        columns=[*list(_CYCLE_COLUMNS)[2:], *_vectors(protocol)],
    )
    table.insert(0, "trial", np.repeat(np.array([e.id for e in entries], dtype=np.int64), rows))
    table.insert(1, "k", np.arange(len(recorded.q)) - np.repeat(recorded.first[:-1], rows))
    return table


def _vectors(protocol: Protocol) -> dict[str, tuple[str, str]]:
    arm, m = protocol.arm, protocol.rows.m
    units = ["m" if p else "rad" for p in arm.prismatic]
    return {
        **{f"v{_axis(k, m)}": ("m/cycle", "commanded velocity") for k in range(m)},
        **{name: (unit, "joint when the cycle began") for name, unit in zip(arm.joint_names, units, strict=True)},
        **{_axis(k, m): ("m", "tool point when the cycle began") for k in range(m)},
    }


def _axis(k: int, m: int) -> str:
    return "xyz"[k] if m <= 3 else str(k + 1)


def dictionary(protocol: Protocol) -> pd.DataFrame:
    """What each column of the tables means: table, column, unit, description."""
    import pandas as pd

    rows = [("trials", name, *about) for name, about in _COLUMNS.items()]
    rows += [("cycles", name, *about) for name, about in {**_CYCLE_COLUMNS, **_vectors(protocol)}.items()]
    return pd.DataFrame(rows, columns=["table", "column", "unit", "description"])


@says("writing the tables")
def export(records: Records, folder: str | Path, parquet: bool = False) -> list[Path]:
    """Write ``trials``, ``cycles``, ``subjects`` and ``events``, with ``dictionary.csv`` and the protocol.

    Args:
        records: The records.
        folder: Made if it is not there; files of these names in it are replaced.
        parquet: Parquet in place of CSV for the four tables.

    Returns:
        The files.

    Raises:
        HoldfastError: Parquet was asked for and pyarrow is not installed.
        StoreError: The records are damaged, or a file cannot be written.
    """
    import pandas as pd

    if parquet:
        try:
            import pyarrow  # noqa: F401
        except ModuleNotFoundError:
            raise HoldfastError("Parquet needs pyarrow; install 'holdfast[parquet]', or export CSV") from None
    subjects = [
        {"subject": s.code, "kind": s.kind.value, "number": s.number, "row": s.row, "state": s.state.value, "since": s.since}
        | {"note": s.note}
        | {f"answer {key}": value for key, value in s.answers.items()}
        for s in records.subjects()
    ]
    events = [{**e, "data": json.dumps(e["data"], ensure_ascii=False) if e["data"] else ""} for e in records.events()]
    tables = {
        "trials": trial_table(records, (Kind.TRAINING, Kind.TRIAL)),
        "cycles": _cycles(records),
        "subjects": pd.DataFrame(subjects),
        "events": pd.DataFrame(events),
    }
    path = made(folder)
    written = []
    for name, table in tables.items():
        file = path / f"{name}.{'parquet' if parquet else 'csv'}"
        if parquet:
            with guarded(path):
                table.to_parquet(file, index=False)
        else:
            replaced(file, csv_text(table))
        written.append(file)
    file = path / "dictionary.csv"
    replaced(file, csv_text(dictionary(records.protocol)))
    return [*written, file, records.protocol.write(path / "protocol.yaml")]
