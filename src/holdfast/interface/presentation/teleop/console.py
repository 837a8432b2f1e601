"""Console text of an experiment: protocol, subjects, allocation, and results of simulated operators."""

from __future__ import annotations

from typing import TYPE_CHECKING

from holdfast.interface.presentation.printing import TextTable, print_table

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.teleop.protocol.protocol import Protocol
    from holdfast.teleop.records.records import Records


def show_experiment(records: Records, out: Console) -> None:
    """Print the outcomes of the trials of simulated operators."""
    from holdfast.teleop.records.entries import TrialKind
    from holdfast.teleop.trials.recordings import End

    people = records.subjects()
    finished = [scenario for scenario in people if scenario.state == "completed"]
    training = len(records.entries(kind=TrialKind.TRAINING))
    text = f"{len(finished)} of {len(people)} simulated operators completed the experiment; {training} training tasks."
    out.print(text, soft_wrap=True)
    rows, entries = [], records.entries(kind=TrialKind.TRIAL)
    for index, scenario in enumerate(records.protocol.scenarios):
        endings = [ending.end for ending in entries if ending.scenario == index]
        counts = [str(endings.count(ending)) for ending in (End.ARRIVED, End.ABORTED, End.TIME)]
        rows.append([str(scenario.number), scenario.label, *counts])
    print_table(out, TextTable(["scenario", "", "completed", "aborted", "timed out"], rows))
    out.print(f"written: {records.folder}; next: holdfast teleop analyse {records.folder}", markup=False, soft_wrap=True)


def show_subjects(records: Records, out: Console) -> None:
    """Print the subjects with the progress of their sessions."""
    from holdfast.teleop.records.session import Session

    rows = []
    for subject in records.subjects():
        progress = Session(records, subject.code).progress()
        cells = (subject.code, subject.kind.value, str(subject.row + 1), subject.state.value, progress, subject.since[:10])
        rows.append(cells)
    if rows:
        print_table(out, TextTable(["subject", "kind", "row", "session", "done", "since"], rows))
    else:
        out.print("no subjects yet")


def show_protocol(protocol: Protocol, out: Console) -> None:
    """Print the protocol."""
    from rich.markup import escape

    training = protocol.training
    limit = "no time limit" if protocol.cycle_limit is None else f"at most {protocol.cycle_limit} cycles"
    for sentence in (
        f"{protocol.name}",
        f"Arm {protocol.arm.name}, task {protocol.rows.name}, {protocol.rate:g} cycles/s of {protocol.substeps} sub-steps",
        f"Joystick: up to {protocol.stick.limit:g} m/cycle ({protocol.stick.limit * protocol.rate:g} m/s), dead zone "
        f"{protocol.stick.dead_zone:g} m/cycle",
        f"End of a trial: at rest within {protocol.radius:g} m of the target; {limit}",
        f"Training: {training.at_least} to {training.most} tasks of {training.distance:g} m, until {training.in_a_row} in a "
        f"row take at most {training.limit:g} cycles ({training.limit / protocol.rate:.3g} s)",
        f"Subjects: {protocol.subjects}, {len(protocol.task_order())} rows of the balanced square, "
        f"{len(protocol.tasks) * len(protocol.scenarios)} trials each",
        f"Rating: {', '.join(protocol.rating)}",
    ):
        out.print(escape(sentence), soft_wrap=True)
    scenarios, tasks = [], []
    for scenario in protocol.scenarios:
        options = ", ".join(
            f"{key} {option:g}" if isinstance(option, float) else f"{key} {option}" for key, option in scenario.options.items()
        )
        scenarios.append([str(scenario.number), scenario.label + (f" ({options})" if options else "")])
    print_table(out, TextTable(["scenario", ""], scenarios))
    start = protocol.arm.forward_kinematics(protocol.tasks.q0)[:, :3, 3] @ protocol.rows.rows[:, :3].T
    for key, note in enumerate(protocol.notes):
        joint = protocol.arm.joint_names[protocol.tasks.joint[key]] if protocol.tasks.joint[key] >= 0 else "none"
        distance = float(((protocol.tasks.target[key] - start[key]) ** 2).sum() ** 0.5)
        tasks.append([str(key + 1), joint, f"{distance:.3f}", note])
    print_table(out, TextTable(["task", "failing joint", "distance to target, m", "note"], tasks))


def show_allocation(protocol: Protocol, subjects: int | None, out: Console) -> None:
    """Print a line for each subject: the row of the balanced square, and the tasks with their scenarios in order."""
    order, rows = protocol.task_order(), []
    for subject in range(protocol.subjects if subjects is None else subjects):
        session = protocol.session_order(subject % len(order), subject).reshape(len(protocol.tasks), -1, 2) + 1
        task_texts = " ".join(f"{trials[0, 0]}:{'/'.join(map(str, trials[:, 1]))}" for trials in session)
        rows.append([str(subject + 1), str(subject % len(order) + 1), task_texts])
    print_table(out, TextTable(["subject", "row", "order of the tasks, each with the order of its scenarios"], rows))
