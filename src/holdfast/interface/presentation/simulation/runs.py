"""Presentation of closed-loop runs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from holdfast.control.simulation.errors import error_history
from holdfast.control.simulation.runs import UNDECIDED_REASONS, Reason, RunOutcome, Runs
from holdfast.core.files.output import write_table
from holdfast.core.formatting import format_number
from holdfast.interface.presentation.collision.contacts import list_contacts, tabulate_contacts
from holdfast.interface.presentation.collision.shape import summarize_shape
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Notice, Presentation, TableSpec, make_headers
from holdfast.interface.presentation.simulation.errors import REACHED_ERROR, format_errors, list_error_facts, list_errors
from holdfast.interface.presentation.simulation.runs_figures import RunDrawing
from holdfast.kinematics.paths.joint_table import joint_columns


def to_dict(runs: Runs) -> dict[str, Any]:
    """Return one run by name; for many runs each number is a list."""
    arm, unit = runs.law.arm, runs.unit

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


def present(runs: Runs, k: int | None = None) -> Presentation:
    """Present the outcome of run k, or the number of each outcome if there are many runs and no k is given."""
    if k is None and runs.code.ndim:
        return _present_outcomes(runs)
    drawing = RunDrawing(runs, k or 0)
    law, arm, unit, run_index = runs.law, drawing.arm, runs.unit, k or 0
    reason = Reason(int(drawing.get_run_array("reason")))
    about = f"Arm {arm.title}, {law.describe()}; locked: {', '.join(drawing.lock_texts) or 'no joint'}"
    title = f"{arm.name} {'after an undetected lock' if drawing.lock_texts else 'without a lock'}"
    if reason == Reason.BAD_INPUT:
        return Presentation(title, f"The run was not simulated: {reason.sentence}.", about=about, arm=arm)
    path_length, time = (float(drawing.get_run_array(name)) for name in ("path_length", "time"))
    checks = [
        (runs.limits_sentence(run_index), bool(drawing.get_run_array("limits_passed").any())),
        (runs.contact_sentence(run_index), bool(drawing.contacts)),
    ]
    return Presentation(
        title,
        _compose_answer(drawing),
        about=about,
        lines=[sentence for sentence, is_violation in checks if sentence and not is_violation],
        notices=[Notice(sentence) for sentence, is_violation in checks if is_violation],
        facts=[
            *list_error_facts(runs, drawing.error_curve, drawing.smallest_errors, run_index),
            Fact("length of the tool path", path_length, "m", phrase="length of the tool path" * (path_length > REACHED_ERROR)),
            *([] if law.task.angular else [Fact("largest distance from a straight line", runs.line_deviation(run_index), "m")]),
            Fact("simulated time", time, unit, phrase="simulated time" * (time > REACHED_ERROR)),
            *[
                Fact("", contact.time, unit, phrase=f"until {contact.link} touches {contact.object}")
                for contact in drawing.contacts[:1]
            ],
        ],
        tables=[_tabulate_joints(drawing), *([tabulate_contacts(drawing.contacts, unit)] if drawing.contacts else [])],
        figures={"run": FigureSpec(drawing.draw_figure, on_page=False)},
        sections=drawing.build_sections,
        method=[("Law", law.describe())],
        arm=arm,
        exports={"run.csv": lambda path: runs.to_csv(path, run_index)},
    )


def _present_outcomes(runs: Runs) -> Presentation:
    """Present many runs by their outcomes."""
    counts, passes_limit = runs.counts(), np.atleast_2d(runs.limits_passed).any(axis=1)
    rows: list[tuple[str, int]] = [*counts.items(), ("past a joint limit on the way", int(passes_limit.sum()))]
    lines = []
    if passes_limit.any():
        converged_count = int((passes_limit & (runs.code == RunOutcome.CONVERGED)).sum())
        lines.append(f"{passes_limit.sum()} of them pass a joint limit on the way; {converged_count} of these converge.")
    for reason in UNDECIDED_REASONS:
        if count := int((runs.reason == reason).sum()):
            limit_text = f", {runs._settings.time_limit:.6g} {runs.unit}" if reason == Reason.TIME_LIMIT else ""
            lines.append(f"{count} undecided{limit_text}: {reason.sentence}.")
    if runs.contacts is not None:
        lines.append(f"{runs.contact_sentence().removesuffix('.')}.")
        rows.append(("touch something on the way", len({contact.run for contact in runs.contacts})))
    return Presentation(
        f"{len(runs):,} runs of {runs.law.arm.name} without fault information in the controller",
        f"{len(runs):,} runs: {', '.join(f'{count:,} {name}' for name, count in counts.items())}.",
        about=f"Arm {runs.law.arm.title}, {runs.law.describe()}",
        lines=lines,
        tables=[TableSpec("Outcomes", ["outcome", "runs"], rows)],
        figures={"run": FigureSpec(RunDrawing(runs, 0).draw_figure, "The first run")},
        method=[("Law", runs.law.describe())],
        arm=runs.law.arm,
        exports={"run.csv": runs.to_csv},
    )


def _compose_answer(drawing: RunDrawing) -> str:
    """Compose the outcome of one run, and the smallest error found for the failed arm."""
    runs, code, unit = drawing.runs, RunOutcome(int(drawing.get_run_array("code"))), drawing.time_unit
    end, smallest_errors = drawing.error_curve.end, drawing.smallest_errors
    error_phrase = f"{format_errors(runs.law, end.position, end.angle)} off its target"
    duration_text = f"{format_number(float(drawing.get_run_array('time')))} {unit}"
    names = " and ".join(lock_text.replace(f" at 0 {unit}", " at the start") for lock_text in drawing.lock_texts)
    opening = f"After an undetected lock of {names}, the arm" if names else "With no joint locked, the arm"
    reason = Reason(int(drawing.get_run_array("reason")))
    if code == RunOutcome.CONVERGED:
        return f"{opening} reaches its target after {duration_text} (simulated time)."
    if code == RunOutcome.STUCK:
        answer = f"{opening} stops {error_phrase}"
    elif code == RunOutcome.MOVING:
        answer = (
            f"{opening} never stops, because it repeats its motion; after {duration_text} (simulated time) it is {error_phrase}"
        )
    elif reason == Reason.TIME_LIMIT:
        answer = f"{opening} {runs.ending_sentence(drawing.run_index)}, {error_phrase}"
    else:
        answer = f"{opening} is {error_phrase} when the run ends, undecided: {reason.sentence}"
    if max(smallest_errors) > REACHED_ERROR:
        smallest_text = format_errors(runs.law, *smallest_errors)
        return f"{answer}; the smallest error found for the failed arm is {smallest_text}."
    return f"{answer}, although it could reach the target with this lock." if drawing.lock_texts else f"{answer}."


def _tabulate_joints(drawing: RunDrawing) -> TableSpec:
    """Tabulate the joint positions at the start and at the end, and their range on the way."""
    factors, units = zip(*(joint.display_unit for joint in drawing.arm.joints), strict=True)
    values = [factors * drawing.get_run_array(name) for name in ("q0", "q_final", "q_low", "q_high")]
    notes = [
        ", ".join(["locked"] * bool(np.isfinite(lock_time)) + ["passes its limits"] * bool(is_passed))
        for lock_time, is_passed in zip(drawing.lock_time, drawing.get_run_array("limits_passed"), strict=True)
    ]
    columns = make_headers("start", "end", "smallest", "largest", unit=units)
    rows = list(zip(drawing.arm.joint_names, *values, notes, strict=True))
    return TableSpec("Joint positions", ["joint", *columns, ""], rows)


def to_csv(runs: Runs, file: Path, k: int) -> Path:
    """Write the samples of run k as rows of a table."""
    law, path = runs.law, RunDrawing(runs, k).full_path
    header = ["time_cycles" if runs.cycles else "time_s", *joint_columns(law.arm), "tool_x_m", "tool_y_m", "tool_z_m"]
    columns = [path.time, path.q, path.x]
    if law.task.rows[:, :3].any():
        header, columns = [*header, "position_error_mm"], [*columns, 1000 * path.position_error]
    if law.task.angular:
        header, columns = [*header, "angle_error_deg"], [*columns, np.rad2deg(path.angle_error)]
    if runs.clearance is not None:
        header, columns = [*header, "clearance_m"], [*columns, runs.clearance(path.q)]
    return write_table(file, "motion", header, np.column_stack(columns))
