"""An experiment in words: its protocol, its subjects, who does which task when, and what a run of programs gave."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.teleop.protocol.protocol import Protocol
    from holdfast.teleop.records.records import Records


def _table(*head: str) -> Any:
    from holdfast.present.terminal import Grid

    return Grid(*head)


def show_experiment(records: Records, out: Console) -> None:
    """How the trials of simulated people ended."""
    from holdfast.teleop.records.entries import Kind
    from holdfast.teleop.trials.recordings import End

    people = records.subjects()
    done = [s for s in people if s.state == "completed"]
    training = len(records.entries(kind=Kind.TRAINING))
    out.print(f"{len(people)} simulated operators, {len(done)} trained and done; {training} training tasks", soft_wrap=True)
    table = _table("scenario", "", "completed", "aborted", "time over")
    entries = records.entries(kind=Kind.TRIAL)
    for k, s in enumerate(records.protocol.scenarios):
        ends = [e.end for e in entries if e.scenario == k]
        table.add_row(str(s.number), s.label, *(str(ends.count(e)) for e in (End.ARRIVED, End.ABORTED, End.TIME)))
    out.print(table)
    out.print(f"written: {records.folder}; next: holdfast teleop analyse {records.folder}", markup=False, soft_wrap=True)


def show_subjects(records: Records, out: Console) -> None:
    """How far their sessions are."""
    from rich.markup import escape

    from holdfast.teleop.records.session import Session

    table = _table("subject", "kind", "row", "session", "done", "since")
    people = records.subjects()
    for s in people:
        progress = Session(records, s.code).progress()
        table.add_row(escape(s.code), s.kind.value, str(s.row + 1), s.state.value, progress, s.since[:10])
    out.print(table if people else "no subjects yet")


def show_protocol(p: Protocol, out: Console) -> None:
    """What it holds."""
    from rich.markup import escape

    training = p.training
    limit = "no limit" if p.cycle_limit is None else f"at most {p.cycle_limit} cycles"
    for line in (
        f"{p.name}",
        f"arm {p.arm.name}, task {p.rows.name}, {p.rate:g} cycles/s, {p.substeps} sub-steps in each",
        f"stick: up to {p.stick.limit:g} m/cycle ({p.stick.limit * p.rate:g} m/s), dead zone {p.stick.dead_zone:g} m/cycle",
        f"a trial ends at rest within {p.radius:g} m of the target; {limit}",
        f"training: {training.at_least} tasks or more of {training.distance:g} m, the last {training.in_a_row} in a row within "
        f"{training.limit:g} cycles ({training.limit / p.rate:.3g} s), at most {training.most}",
        f"{p.subjects} subjects, {len(p.order())} rows of the balanced square, {len(p.tasks) * len(p.scenarios)} trials each",
        f"rating: {', '.join(p.rating)}",
    ):
        out.print(escape(line), soft_wrap=True)
    table = _table("scenario", "")
    for s in p.scenarios:
        options = ", ".join(f"{k} {v:g}" if isinstance(v, float) else f"{k} {v}" for k, v in s.options.items())
        table.add_row(str(s.number), escape(s.label + (f" ({options})" if options else "")))
    out.print(table)
    tasks = _table("task", "joint that fails", "from start to target, m", "note")
    start = p.arm.forward_kinematics(p.tasks.q0)[:, :3, 3] @ p.rows.rows[:, :3].T
    for k, note in enumerate(p.notes):
        joint = p.arm.joint_names[p.tasks.joint[k]] if p.tasks.joint[k] >= 0 else "none"
        away = float(((p.tasks.target[k] - start[k]) ** 2).sum() ** 0.5)
        tasks.add_row(str(k + 1), escape(joint), f"{away:.3f}", escape(note))
    out.print(tasks)


def show_allocation(p: Protocol, subjects: int | None, out: Console) -> None:
    """A line for each subject: the row of the square, and the tasks with their scenarios in order."""
    order = p.order()
    table = _table("subject", "row", "tasks in order, each with its scenarios in order")
    for k in range(p.subjects if subjects is None else subjects):
        session = p.session(k % len(order), k).reshape(len(p.tasks), -1, 2) + 1
        words = " ".join(f"{of[0, 0]}:{'/'.join(map(str, of[:, 1]))}" for of in session)
        table.add_row(str(k + 1), str(k % len(order) + 1), words)
    out.print(table)
