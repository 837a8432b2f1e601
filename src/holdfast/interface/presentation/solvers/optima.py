"""Presentation of the best configurations of tool poses."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.files.output import open_replacement
from holdfast.core.files.spreadsheet import escape_formula
from holdfast.core.formatting import capitalise_first, format_number, format_percent
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.console import list_limit_violations
from holdfast.interface.presentation.arm.view import build_view_section
from holdfast.interface.presentation.arm_page.build import build_live_picture
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.indices.console import display_unit
from holdfast.interface.presentation.presentation import (
    Column,
    Fact,
    Header,
    Notice,
    Presentation,
    TableSpec,
    format_value,
    make_headers,
)
from holdfast.interface.report.page import Section
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.indices.objective import NegatedObjective, Objective, WeightedSum
from holdfast.kinematics.indices.susceptibility.measure import Susceptibility
from holdfast.kinematics.solvers.optima import Optima

_NEGLIGIBLE_CHANGE = 1e-4  # relative change below which the configuration before counts as the best one
_MAX_RELATIVE_CHANGE = 10.0  # larger relative changes are not printed, because a percentage would not be informative
MANY_AGREEING_FRACTION = 0.5  # fraction of agreeing starts below which more starts may find a better optimum


def to_dict(optima: Optima, asked: str = "") -> dict[str, Any]:
    """Return the results of all poses as JSON data; ``asked`` is the objective as worded on the command line."""
    optima_rows, names = optima.rows, optima.arm.joint_names
    value_before, before, is_worse = optima_rows.value_before, optima_rows.q_before, optima_rows.worse
    clearance_before, clearance_after = optima_rows.clearance_at(optima_rows.q_before), optima_rows.clearance_at(optima_rows.q)
    measures = list(_compare_measures(optima_rows))

    def map_by_joint(values: FloatArray) -> dict[str, Any]:
        return dict(zip(names, values.tolist(), strict=True))

    def build_row(pose_index: int) -> dict[str, Any]:
        return {
            "pose": optima_rows.poses[pose_index],
            "status": _status_name(optima_rows.status[pose_index]),
            "value_before": value_before[pose_index],
            "value": optima_rows.value[pose_index],
            "worse_than_given": is_worse[pose_index],
            "q_before": map_by_joint(before[pose_index]),
            "q": map_by_joint(optima_rows.q[pose_index]),
            "clearance_before_m": clearance_before[pose_index],
            "clearance_m": clearance_after[pose_index],
            "blocked": optima_rows.blocked[pose_index] if optima_rows.clearance is not None else None,
            "blocked_by": optima_rows.obstacles[pose_index] or None,
            "starts": optima_rows.starts[pose_index],
            "agreeing": optima_rows.agreeing[pose_index],
            "position_error_m": optima_rows.position_error[pose_index],
            "rotation_error_rad": optima_rows.rotation_error[pose_index],
            "measures": {
                label: {
                    name: {"unit": unit, "before": before_values[pose_index, joint], "after": after_values[pose_index, joint]}
                    for joint, (name, unit) in enumerate(zip(names, units, strict=True))
                }
                for label, units, before_values, after_values in measures
            },
        }

    return {
        **optima.arm.entry(),
        "objective": asked or _describe_objective(optima),
        "better": optima.objective.better,
        "unit": optima.objective.unit,
        "task": optima.task.name,
        "before": "found" if optima.initial is None else "given",
        "seed": optima.seed,
        "clearance": None if optima.clearance is None else summarize_shape(optima.clearance, optima.margin),
        "failures": _format_failures(optima),
        "cap": None if optima.cap is None else asdict(optima.cap) | {"remaining": _format_remaining_failures(optima)},
        "poses": [build_row(k) for k in range(len(optima_rows.poses))],
    }


def present(optima: Optima, asked: str = "") -> Presentation:
    """Present the gain of the best configurations; ``asked`` is the objective as worded on the command line."""
    rows, name, unit = optima.rows, optima.objective.name, display_unit(optima.objective)
    is_solved, reference, is_single = rows.success, f"the {_name_reference(optima)}", len(rows.poses) == 1
    before, after = (
        float(np.median(values[is_solved])) if is_solved.any() else np.nan for values in (rows.value_before, rows.value)
    )
    facts: list[Fact] = []
    lines: list[str] = []
    if is_solved.any():
        median = "" if is_single else "s, median"
        facts += [
            Fact("best found", after, unit, phrase=f"{name} at the best configuration{median}", digits=6),
            Fact(f"before ({reference})", before, unit, phrase=f"before: {reference}", digits=6),
        ]
    if is_single:
        agreeing, starts = float(rows.agreeing[0]), int(rows.starts[0])
        phrase = f"of the {starts:,} completed local searches found the same optimum"
        facts.append(Fact("completed local searches" if rows.free else "local searches that met the pose", starts))
        facts.append(Fact("searches that found this optimum", agreeing, phrase=phrase, style="percent"))
        if not agreeing >= MANY_AGREEING_FRACTION:
            lines.append("The objective has many local optima, so more --starts may find a better one.")
        if is_solved[0] and not rows.free:
            facts += [
                Fact("position error", float(rows.position_error[0]), "m", digits=2),
                Fact("rotation error", float(rows.rotation_error[0]), "rad", digits=2),
            ]
    else:
        facts.append(
            Fact("", f"{int(is_solved.sum())} of {len(is_solved)}", phrase="poses for which a configuration was found")
        )
        lines.append(f"Before: {reference}. Use --csv FILE or --json to get the configurations.")
    failures = _format_failures(optima)
    shape = "not checked" if optima.clearance is None else describe_shape(optima.clearance, optima.margin)
    notices = list_limit_violations(optima.arm, rows.q_before[0], " before") if is_single else []
    notices += [
        Notice(f"{_status_name(status).replace('_', ' ')}: {Status(status).sentence}")
        for status in sorted({*map(int, rows.status)} - {int(Status.OK)})
    ]
    if optima.cap is not None:
        notices.append(Notice(f"{optima.cap}. Use --failures '{_format_remaining_failures(optima)}' to optimise without it."))
    if optima.initial is not None and rows.worse.any():
        pose_count = "" if is_single else f" of {int(rows.worse.sum())} poses"
        notices.append(
            Notice(f"The given configuration{pose_count} is better than any configuration found; use more --starts.")
        )
    if optima.clearance is not None:
        clearance_facts, sentence = _compare_clearance(rows)
        facts += clearance_facts
        lines.append(sentence)
    starts_text = ", ".join(f"{starts:,}" for starts in sorted({*map(int, rows.starts)}))
    return Presentation(
        f"The best {'of all configurations' if optima.free else 'configuration'} of {optima.arm.name} before a failure",
        _compose_answer(optima, before, after),
        about=f"{capitalise_first(asked or _describe_objective(optima))}"
        f"{'' if failures is None else f' over failures {failures}'}, arm {optima.arm.title}, task {optima.task.describe()}",
        lines=lines,
        notices=notices,
        facts=facts,
        tables=[_tabulate_joints(rows) if is_single else _tabulate_poses(rows, unit)],
        sections=partial(_draw_comparison, rows, reference) if is_solved.any() else tuple,
        method=[
            ("Objective", f"{name}, {optima.objective.better} is better"),
            ("Task", optima.task.describe()),
            ("Starts", f"{starts_text} random starts{' for each pose' * (not optima.free)}, seed {optima.seed}"),
            ("Clearance", shape),
        ],
        arm=optima.arm,
    )


def _compose_answer(optima: Optima, before: float, after: float) -> str:
    """Compose the answer from the medians of the objective over the poses."""
    rows, unit = optima.rows, display_unit(optima.objective)
    before_text, after_text = (format_value(value, unit=unit) for value in (before, after))
    reference, is_solved, has_many_poses = f"the {_name_reference(optima)}", rows.success, len(rows.poses) > 1
    subject = f"the median of {optima.objective.name}" if has_many_poses else optima.objective.name
    change = abs(after - before) / abs(before) if before else np.inf
    count_text = f" (a configuration was found for {int(is_solved.sum())} of {len(is_solved)} poses)" * has_many_poses
    if not is_solved.any():
        pose = "any pose" if has_many_poses else "the pose"
        return f"No configuration of {pose} was found: {Status(int(rows.status[0])).sentence}."
    if optima.initial is not None and rows.worse[is_solved].all():
        answer = f"No configuration better than {reference} was found: {subject} stays {before_text}"
    elif change < _NEGLIGIBLE_CHANGE:
        answer = f"No configuration better than {reference} was found: {subject} is {after_text}"
    elif rows.free:
        answer = f"The best configuration found has a {optima.objective.name} of {after_text}; {reference} has {before_text}"
    else:
        is_larger = optima.objective.better == "larger"
        change_text = f", {format_percent(change)} {'more' if is_larger else 'less'}" * bool(change < _MAX_RELATIVE_CHANGE)
        answer = (
            f"A self-motion {'raises' if is_larger else 'lowers'} {subject} from {format_number(before, 4)} to "
            f"{after_text}{change_text}; the tool pose does not change"
        )
    return f"{answer}{count_text}."


def _tabulate_joints(rows: Optima) -> TableSpec:
    """Tabulate the configuration and the measures of a single pose joint by joint."""
    units, arm = [joint.unit for joint in rows.arm.joints], rows.arm
    columns: list[Column] = ["joint"]
    values = [list(arm.joint_names)]
    for label, joint_units, before, after in [("", units, rows.q_before, rows.q), *_compare_measures(rows)]:
        for moment, numbers in (("before", before), ("best", after)):
            columns.append(Header(f"{label} {moment}".strip(), joint_units, style="angle", digits=5))
            values.append(numbers[0].tolist())
    return TableSpec("Configurations, before and best", columns, list(zip(*values, strict=True)))


def _tabulate_poses(rows: Optima, unit: str) -> TableSpec:
    """Tabulate the objective of each pose."""
    columns: list[Column] = [
        "pose",
        *make_headers("before", "best", unit=unit, digits=6, aligned=False),
        Header("same optimum", style="percent"),
        "of searches",
        "",
    ]
    status_texts = ["" if status == Status.OK else _status_name(status).replace("_", " ") for status in rows.status]
    numbers = range(1, len(rows.poses) + 1)
    values = zip(numbers, rows.value_before, rows.value, rows.agreeing, rows.starts, status_texts, strict=True)
    return TableSpec("Objective, before and best", columns, list(values))


def _compare_clearance(rows: Optima) -> tuple[list[Fact], str]:
    """Return the clearance before and after, and a sentence on better configurations that were rejected as too close."""
    assert rows.clearance is not None
    collision_phrase, blocked_count = rows.clearance.too_close(rows.margin), int(rows.blocked.sum())
    if len(rows.poses) == 1:
        facts = [
            Fact(f"clearance {moment}", float(rows.clearance_at(q)[0]), "m", digits=3)
            for moment, q in (("before", rows.q_before), ("of the best", rows.q))
        ]
        text = f"The arm was checked for collisions with {rows.clearance.everything}"
        if blocked_count:
            text += f"; a better configuration {collision_phrase} and was rejected: {rows.obstacles[0]}"
    else:
        facts = []
        before, after = (int(rows.close(q).sum()) for q in (rows.q_before, rows.q))
        text = f"The arm {collision_phrase} in {before} of {len(rows.poses)} configurations before, in {after or 'none'} after"
        if blocked_count:
            text += f"; at {blocked_count} poses a better configuration does and was rejected"
    return facts, f"{text} ({describe_shape(rows.clearance, rows.margin)})."


def _draw_comparison(rows: Optima, reference: str) -> list[Section]:
    pose_index = int(rows.success.argmax())
    cell = None if rows.clearance is None else rows.clearance.cell
    caption = f"The arm at its best configuration and, transparent, at {reference}"
    caption += "." if rows.free else ". Both have the same tool pose."
    section = build_view_section(
        "Before and best",
        rows.arm,
        np.array([rows.q[pose_index], rows.q_before[pose_index]]),
        caption + f" Pose {pose_index + 1}." * (len(rows.poses) > 1),
        name="both",
        labels=("best", "before"),
        targets=[] if rows.free else [rows.poses[pose_index]],
        cell=cell,
    )
    live = build_live_picture(rows.arm, rows.q[pose_index], rows.task, cell)
    return [replace(section, blocks=[*section.blocks, live])]


def to_csv(optima: Optima, path: Path) -> Path:
    """Write the configurations as a CSV file, one row for each pose."""
    optima_rows = optima.rows
    names = [f"{joint.name}_{joint.unit}" for joint in optima_rows.arm.joints]
    columns = ["pose", "status", "value_before", "value", "starts", "agreeing", "position_error_m", "rotation_error_rad"]
    facts = ("value_before", "value", "starts", "agreeing", "position_error", "rotation_error")
    rows = np.column_stack([*(getattr(optima_rows, name) for name in facts), optima_rows.q])
    with open_replacement(path, "configurations") as file:
        table = csv.writer(file)
        table.writerow(map(escape_formula, columns + names))
        for index, row in enumerate(rows):
            table.writerow([index + 1, _status_name(optima_rows.status[index]), *[f"{entry:.12g}" for entry in row]])
    return path


def _format_failures(optima: Optima) -> str | None:
    """Format the failures of an index for --failures; None if they are the default, each joint alone."""
    index = optima.objective
    if not isinstance(index, Index) or index.failures == tuple((joint,) for joint in range(index.arm.n)):
        return None
    return _format_failure_sets(index.failures)


def _format_remaining_failures(optima: Optima) -> str:
    """Format the failures other than the one that caps the value for --failures."""
    assert optima.cap is not None
    assert isinstance(optima.objective, Index)
    return _format_failure_sets([optima.objective.failures[failure_index] for failure_index in optima.cap.remaining])


def _format_failure_sets(failures: Sequence[Sequence[int]]) -> str:
    """Format sets of joints, indices from 0, as ``1; 2+3``; a lone number would mean the number of failing joints."""
    text = "; ".join("+".join(str(joint + 1) for joint in failure) for failure in failures)
    return f"{text};" if text.isdecimal() else text


def _status_name(status: Any) -> str:
    return Status(int(status)).name.lower()


def _name_reference(optima: Optima) -> str:
    """Return the name of the configurations with which the best ones are compared."""
    if optima.initial is not None:
        return "configuration given"
    return "best random configuration" if optima.free else "first configuration found"


def _describe_objective(optima: Optima) -> str:
    """Return the objective in the wording of the command line."""
    objective = optima.objective
    verb = "maximise" if objective.better == "larger" else "minimise"
    return f"{verb} {getattr(objective, 'label', objective.name)}"


def _compare_measures(optima_rows: Optima) -> Iterator[tuple[str, tuple[str, ...], FloatArray, FloatArray]]:
    """Yield for every summand its name, the unit of each joint, and the values of each joint before and after, (N, n)."""
    measures_by_name: dict[str, tuple[Index | Susceptibility, tuple[str, ...]]] = {}
    for measure in _list_summands(optima_rows.objective):
        if isinstance(measure, Susceptibility):
            measures_by_name[measure.slug] = measure, measure.joint_unit
        elif isinstance(measure, Index):
            measures_by_name[measure.label] = _with_single_failures(measure), (measure.unit,) * optima_rows.arm.n
    for label, (measure, units) in measures_by_name.items():
        yield label, units, measure.by_joint(optima_rows.q_before), measure.by_joint(optima_rows.q)


def _with_single_failures(index: Index) -> Index:
    """Return the index with a value for each joint, also for joints whose failure was left out."""
    return index if index.failures == tuple((joint,) for joint in range(index.arm.n)) else index.with_failures("single")


def _list_summands(objective: Objective) -> list[Objective]:
    if isinstance(objective, NegatedObjective):
        return _list_summands(objective.objective)
    return [term for _, term in objective.terms] if isinstance(objective, WeightedSum) else [objective]
