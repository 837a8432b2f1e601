"""Runs of the closed loop in numbers and words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.present.clearance.contacts import contact_entries, contact_table
from holdfast.present.clearance.shape import shape_summary
from holdfast.present.printing import Rows, alike, number, print_rows
from holdfast.present.simulation.errors import error_entries, error_rows
from holdfast.simulation.errors import error_history
from holdfast.simulation.runs import Reason, Runs

if TYPE_CHECKING:
    from rich.console import Console


def to_dict(runs: Runs) -> dict[str, Any]:
    """One run by name; of many, each number is a list."""
    arm = runs.law.arm
    unit = "cycles" if runs.cycles else "s"

    def by_joint(values: Any) -> dict[str, Any]:
        return dict(zip(arm.joint_names, values.T, strict=True))

    return {
        **arm.entry(),
        "law": runs.law.slug,
        "task": runs.law.task.name,
        "locked": {name: t for name, t in by_joint(runs.lock_time).items() if np.isfinite(t).any()},
        "outcome": runs.outcome,
        "reason": np.array([reason.name.lower() for reason in Reason])[runs.reason],
        f"time_{unit}": runs.time,
        "error": runs.error,
        "least_error": runs.least_error(),
        "closest": runs.closest,
        **({} if runs.code.ndim or runs.reason == Reason.BAD_INPUT else error_entries(runs, error_history(runs))),
        "path_length_m": runs.path_length,
        "x_final": runs.x_final,
        "q_start": by_joint(runs.q0),
        "q_final": by_joint(runs.q_final),
        "q_low": by_joint(runs.q_low),
        "q_high": by_joint(runs.q_high),
        "limits_passed": [name for name, passed in by_joint(runs.limits_passed).items() if passed.any()],
        "limits": {joint.name: [joint.lower, joint.upper] for joint in arm.joints},
    } | _touched(runs, unit)


def _touched(runs: Runs, unit: str) -> dict[str, Any]:
    """What was looked at and what was touched; nothing if nobody looked."""
    if runs.clearance is None or runs.contacts is None:
        return {}
    stopped = {} if runs.stopped is None else {f"stopped_at_{unit}": runs.stopped}
    contacts = contact_entries(runs.contacts, unit, bool(runs.code.ndim))
    return {"contacts": contacts, **stopped, "clearance": shape_summary(runs.clearance, 0.0)}


def sentences(runs: Runs) -> list[str]:
    """How one run ended; of many how often which."""
    if runs.code.ndim:
        return runs.describe()
    ended = f"The end effector {runs.ending_sentence()}."
    return [
        x
        for x in (ended, runs.limits_sentence(), runs.contact_sentence(), f"Arm {runs.law.arm.title}, {runs.law.describe()}.")
        if x
    ]


def key_table(runs: Runs) -> Rows:
    """How the runs ended: one in numbers, many by their outcomes."""
    if runs.code.ndim:
        rows = [[name, f"{count:,}"] for name, count in runs.counts().items()]
        past = np.atleast_2d(runs.limits_passed).any(axis=1)
        rows.append(["past a joint limit on the way", f"{int(past.sum()):,}"])
        if runs.contacts is not None:
            rows.append(["touch something on the way", f"{len({c.run for c in runs.contacts}):,}"])
        return Rows(["outcome", "runs"], rows)
    unit = runs.unit
    locks = [
        f"{name} at {t:g} {unit}" for name, t in zip(runs.law.arm.joint_names, runs.lock_time, strict=True) if np.isfinite(t)
    ]
    rows = [
        ["locked", ", ".join(locks) or "none"],
        ["outcome", str(runs.outcome)],
        *[list(row) for row in error_rows(runs, error_history(runs))],
        ["path of the end effector", f"{number(float(runs.path_length))} m"],
        [f"simulated {'cycles' if runs.cycles else 'time'}", f"{number(float(runs.time))} {unit}"],
    ]
    if runs.contacts is not None:
        rows.append(
            ["touches", ", ".join(f"{c.link} & {c.object} at {number(c.time)} {unit}" for c in runs.contacts) or "nothing"]
        )
    return Rows(["", ""], rows)


def next_steps(runs: Runs, name: str) -> list[str]:
    """The motion itself, and the page with the arm moving."""
    which = "k=0, " if runs.code.ndim else ""
    return [
        f"{name}.path({which}samples=400)  # joints and tool over time",
        f'{name}.report("run.html")  # with the arm moving',
    ]


def show(runs: Runs, out: Console) -> None:
    """One run as tables; of many, the sentences."""
    from rich.markup import escape

    from holdfast.present.terminal import Grid

    if runs.code.ndim:
        for line in runs.describe():
            out.print(escape(line), soft_wrap=True)
        return
    arm, unit = runs.law.arm, "cycles" if runs.cycles else "s"
    locks = [f"{name} at {t:g} {unit}" for name, t in zip(arm.joint_names, runs.lock_time, strict=True) if np.isfinite(t)]
    locked = f"locked: {', '.join(locks)}" if locks else "no joint locked"
    out.print(f"Arm {escape(arm.title)}, {escape(runs.law.describe())}; {escape(locked)}", soft_wrap=True)
    out.print(f"The end effector [bold]{escape(runs.ending_sentence())}[/].", soft_wrap=True)
    if limits := escape(runs.limits_sentence()):
        out.print(f"[yellow]{limits}[/]" if runs.limits_passed.any() else limits, soft_wrap=True)
    if touched := escape(runs.contact_sentence()):
        out.print(f"[yellow]{touched}[/]" if runs.contacts else touched, soft_wrap=True)
    facts = Grid()
    for what, value in error_rows(runs, error_history(runs)):
        facts.add_row(what, value)
    facts.add_row("path of the end effector", f"{number(float(runs.path_length))} m")
    out.print(facts)
    out.print(f"simulated time: {number(float(runs.time))} {unit}")
    table = Grid("joint", "start", "end", "least", "greatest", "")
    factors, units = zip(*(joint.shown for joint in arm.joints), strict=True)
    columns = [alike(factors * x, units) for x in (runs.q0, runs.q_final, runs.q_low, runs.q_high)]
    for k, (joint, *cells) in enumerate(zip(arm.joints, *columns, strict=True)):
        notes = ["locked"] if np.isfinite(runs.lock_time[k]) else []
        notes += ["passes its limits"] if runs.limits_passed[k] else []
        table.add_row(escape(joint.name), *cells, ", ".join(notes))
    out.print(table)
    if runs.contacts:
        print_rows(out, contact_table(runs.contacts, unit))
