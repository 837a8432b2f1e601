"""Text, tables, and JSON of closed-loop runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.simulation.errors import error_history
from holdfast.control.simulation.runs import Reason, Runs
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.collision.shape import summarize_shape
from holdfast.interface.presentation.printing import TextTable, format_column, format_significant, print_table
from holdfast.interface.presentation.simulation.errors import list_errors, tabulate_errors

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(runs: Runs) -> dict[str, Any]:
    """Return one run by name; for many runs each number is a list."""
    arm = runs.law.arm
    unit = "cycles" if runs.cycles else "s"

    def map_by_joint(values: Any) -> dict[str, Any]:
        return dict(zip(arm.joint_names, values.T, strict=True))

    return {
        **arm.entry(),
        "law": runs.law.slug,
        "task": runs.law.task.name,
        "locked": {name: times for name, times in map_by_joint(runs.lock_time).items() if np.isfinite(times).any()},
        "outcome": runs.outcome,
        "reason": np.array([reason.name.lower() for reason in Reason])[runs.reason],
        f"time_{unit}": runs.time,
        "error": runs.error,
        "least_error": runs.least_error(),
        "closest": runs.closest,
        **({} if runs.code.ndim or runs.reason == Reason.BAD_INPUT else list_errors(runs, error_history(runs))),
        "path_length_m": runs.path_length,
        "x_final": runs.x_final,
        "q_start": map_by_joint(runs.q0),
        "q_final": map_by_joint(runs.q_final),
        "q_low": map_by_joint(runs.q_low),
        "q_high": map_by_joint(runs.q_high),
        "limits_passed": [name for name, is_passed in map_by_joint(runs.limits_passed).items() if is_passed.any()],
        "limits": {joint.name: [joint.lower, joint.upper] for joint in arm.joints},
    } | _contact_data(runs, unit)


def _contact_data(runs: Runs, unit: str) -> dict[str, Any]:
    """Return the collision model and the contacts; nothing if contacts were not computed."""
    if runs.clearance is None or runs.contacts is None:
        return {}
    stop_entry = {} if runs.stopped is None else {f"stopped_at_{unit}": runs.stopped}
    contacts = list_contacts(runs.contacts, unit, bool(runs.code.ndim))
    return {"contacts": contacts, **stop_entry, "clearance": summarize_shape(runs.clearance, 0.0)}


def sentences(runs: Runs) -> list[str]:
    """Describe the outcome of one run; for many runs the number of each outcome."""
    if runs.code.ndim:
        return runs.describe()
    outcome_sentence = f"The end effector {runs.ending_sentence()}."
    return [
        sentence
        for sentence in (
            outcome_sentence,
            runs.limits_sentence(),
            runs.contact_sentence(),
            f"Arm {runs.law.arm.title}, {runs.law.describe()}.",
        )
        if sentence
    ]


def key_table(runs: Runs) -> TextTable:
    """Tabulate one run in numbers, or many runs by their outcomes."""
    if runs.code.ndim:
        rows = [[name, f"{count:,}"] for name, count in runs.counts().items()]
        violates_limits = np.atleast_2d(runs.limits_passed).any(axis=1)
        rows.append(["past a joint limit on the way", f"{int(violates_limits.sum()):,}"])
        if runs.contacts is not None:
            rows.append(["touch something on the way", f"{len({contact.run for contact in runs.contacts}):,}"])
        return TextTable(["outcome", "runs"], rows)
    unit = runs.unit
    locks = [
        f"{name} at {lock_instant:g} {unit}"
        for name, lock_instant in zip(runs.law.arm.joint_names, runs.lock_time, strict=True)
        if np.isfinite(lock_instant)
    ]
    rows = [
        ["locked", ", ".join(locks) or "none"],
        ["outcome", str(runs.outcome)],
        *[list(row) for row in tabulate_errors(runs, error_history(runs))],
        ["path of the end effector", f"{format_significant(float(runs.path_length))} m"],
        [f"simulated {'cycles' if runs.cycles else 'time'}", f"{format_significant(float(runs.time))} {unit}"],
    ]
    if runs.contacts is not None:
        rows.append(
            [
                "touches",
                ", ".join(
                    f"{contact.link} & {contact.object} at {format_significant(contact.time)} {unit}"
                    for contact in runs.contacts
                )
                or "nothing",
            ]
        )
    return TextTable(["", ""], rows)


def show(runs: Runs, out: Console) -> None:
    """Print one run as tables; for many runs print the sentences."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    if runs.code.ndim:
        for sentence in runs.describe():
            out.print(escape(sentence), soft_wrap=True)
        return
    arm, unit = runs.law.arm, "cycles" if runs.cycles else "s"
    locks = [
        f"{name} at {lock_instant:g} {unit}"
        for name, lock_instant in zip(arm.joint_names, runs.lock_time, strict=True)
        if np.isfinite(lock_instant)
    ]
    locked = f"locked: {', '.join(locks)}" if locks else "no joint locked"
    out.print(f"Arm {escape(arm.title)}, {escape(runs.law.describe())}; {escape(locked)}", soft_wrap=True)
    out.print(f"The end effector [bold]{escape(runs.ending_sentence())}[/].", soft_wrap=True)
    if limit_text := escape(runs.limits_sentence()):
        out.print(f"[yellow]{limit_text}[/]" if runs.limits_passed.any() else limit_text, soft_wrap=True)
    if contact_text := escape(runs.contact_sentence()):
        out.print(f"[yellow]{contact_text}[/]" if runs.contacts else contact_text, soft_wrap=True)
    facts = BandedTable()
    for label, value in tabulate_errors(runs, error_history(runs)):
        facts.add_row(label, value)
    facts.add_row("path of the end effector", f"{format_significant(float(runs.path_length))} m")
    out.print(facts)
    out.print(f"simulated time: {format_significant(float(runs.time))} {unit}")
    table = BandedTable("joint", "start", "end", "least", "greatest", "")
    factors, units = zip(*(joint.display_unit for joint in arm.joints), strict=True)
    columns = [
        format_column(factors * configuration, units) for configuration in (runs.q0, runs.q_final, runs.q_low, runs.q_high)
    ]
    for index, (joint, *cells) in enumerate(zip(arm.joints, *columns, strict=True)):
        notes = ["locked"] if np.isfinite(runs.lock_time[index]) else []
        notes += ["passes its limits"] if runs.limits_passed[index] else []
        table.add_row(escape(joint.name), *cells, ", ".join(notes))
    out.print(table)
    if runs.contacts:
        print_table(out, tabulate_contacts(runs.contacts, unit))
