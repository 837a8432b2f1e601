"""Text, tables, and JSON of the best configurations of poses."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.files.output import open_replacement
from holdfast.core.files.spreadsheet import escape_formula
from holdfast.core.formatting import capitalise_first, format_percent
from holdfast.core.status import Status
from holdfast.core.typing import FloatArray
from holdfast.interface.presentation.arm.console import print_limit_violations
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import (
    TextTable,
    format_position,
    format_positions,
    format_significant,
    to_json_types,
)
from holdfast.kinematics.indices.index import Index
from holdfast.kinematics.indices.objective import NegatedObjective, Objective, WeightedSum
from holdfast.kinematics.indices.susceptibility.measure import Susceptibility
from holdfast.kinematics.solvers.optima import Optima

if TYPE_CHECKING:
    from rich.console import Console


# _NEGLIGIBLE_CHANGE and _MAX_RELATIVE_CHANGE: changes that are none, and those that a fraction would not tell
_NEGLIGIBLE_CHANGE = 1e-4
_MAX_RELATIVE_CHANGE = 10.0
MANY_AGREEING_FRACTION = 0.5  # fraction of starts that agree, below which more starts are worth it


def to_dict(optima: Optima, asked: str = "") -> dict[str, Any]:
    """Return all poses by name; ``asked`` contains the objective in the wording of the command line."""
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

    data = {
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
    json_data: dict[str, Any] = to_json_types(data)
    return json_data


def key_table(optima: Optima) -> TextTable:
    """Tabulate one pose joint by joint, or one row for each pose."""
    optima_rows, arm = optima.rows, optima.arm
    if len(optima_rows.poses) == 1:
        pairs = zip(arm.joints, optima_rows.q_before[0], optima_rows.q[0], strict=True)
        return TextTable(
            ["joint", "before", "best"],
            [
                [joint.name, format_position(before, joint.unit), format_position(best, joint.unit)]
                for joint, before, best in pairs
            ],
        )
    pose_rows = enumerate(zip(optima_rows.value_before, optima_rows.value, optima_rows.status, strict=True), 1)
    return TextTable(
        ["pose", "before", "best", ""],
        [
            [str(pose_number), format_significant(before), format_significant(best), _status_name(status).replace("_", " ")]
            for pose_number, (before, best, status) in pose_rows
        ],
    )


def story(optima: Optima) -> PageContent:
    """Compose the report: the gain of the best configurations over those before."""
    optima_rows, unit = optima.rows, "" if optima.objective.unit in ("1", "mixed") else f" {optima.objective.unit}"
    is_solved, name = optima_rows.success, optima.objective.name
    values = [pose_values[is_solved] for pose_values in (optima_rows.value_before, optima_rows.value)]
    before, after = (float(np.median(pose_values)) if pose_values.size else np.nan for pose_values in values)
    reference = f"the {_name_reference(optima)}"
    has_many_poses = len(optima_rows.poses) > 1
    median_prefix = "the median of " * has_many_poses
    change = abs(after - before) / abs(before) if before else np.inf
    verb = "raises" if optima.objective.better == "larger" else "lowers"
    if not is_solved.any():
        worst = Status(int(optima_rows.status[0])).sentence
        answer = f"No configuration of {'any pose' if has_many_poses else 'the pose'} was found: {worst}."
    elif optima.initial is not None and optima_rows.worse[is_solved].all():
        answer = (
            f"No configuration better than {reference} was found: {median_prefix}{name} stays "
            f"{format_significant(before)}{unit}."
        )
    elif np.isfinite(change) and change < _NEGLIGIBLE_CHANGE:
        answer = (
            f"{capitalise_first(reference)} is the best that was found already: {median_prefix}{name} is "
            f"{format_significant(after)}{unit}."
        )
    elif optima_rows.free:
        answer = (
            f"The best configuration found has a {name} of {format_significant(after)}{unit}; {reference} has "
            f"{format_significant(before)}{unit}."
        )
    else:
        change_text = (
            f", {format_percent(change)} {'more' if verb == 'raises' else 'less'}"
            if np.isfinite(change) and change < _MAX_RELATIVE_CHANGE
            else ""
        )
        answer = (
            f"Moving the arm on the spot {verb} {median_prefix}{name} from {format_significant(before)} to "
            f"{format_significant(after)}{unit}{change_text}; the tool stays where it is."
        )
    if has_many_poses and is_solved.any():
        answer = answer[:-1] + f" ({int(is_solved.sum())} of {len(is_solved)} poses have a configuration)."
    facts = []
    if is_solved.any():
        facts = [
            (f"{format_significant(after)}{unit}", f"{name} at the best configuration{'s, median' if has_many_poses else ''}"),
            (f"{format_significant(before)}{unit}", f"before: {reference}"),
        ]
        agreeing = optima_rows.agreeing[is_solved]
        if not has_many_poses and not np.isnan(agreeing).any():
            facts.append(
                (
                    format_percent(float(agreeing[0])),
                    f"of the {optima_rows.starts[0]} starts that were followed to the end agree",
                )
            )
    if has_many_poses:
        facts.append((f"{int(is_solved.sum())} of {len(is_solved)}", "poses have a configuration"))
    facts = [pose_values for pose_values in facts if pose_values[0].split()[0] not in ("0", "–")]
    tables = [
        key_table(optima)._replace(
            title="Configurations, before and best" if not has_many_poses else "Objective, before and best"
        )
    ]
    for label, joint_units, before_values, after_values in _compare_measures(optima_rows) if not has_many_poses else ():
        rows = [
            list(row)
            for row in zip(
                optima_rows.arm.joint_names,
                *(format_positions(pose_values[0], joint_units) for pose_values in (before_values, after_values)),
                strict=True,
            )
        ]
        tables.append(TextTable(["joint that fails", "before", "best"], rows, capitalise_first(label.replace("-", " "))))
    return PageContent(
        f"The best {'of all configurations' if optima.free else 'configuration'} of {optima.arm.name} before a failure",
        answer,
        about=f"{capitalise_first(_describe_objective(optima))}, task {optima.task.describe()}",
        facts=facts,
        lines=[
            *([] if optima.cap is None else [_compose_cap_advice(optima)]),
            *[
                f"{Status(int(status_code)).sentence.capitalize()}."
                for status_code in sorted({*map(int, optima_rows.status)})
                if status_code != Status.OK and has_many_poses
            ],
        ],
        views=_draw_comparison(optima_rows, reference) if is_solved.any() else [],
        tables=tables,
        method=[
            ("Objective", f"{name}, {optima.objective.better} is better"),
            ("Task", optima.task.describe()),
            (
                "Starts",
                f"{', '.join(map(str, sorted({*map(int, optima_rows.starts)})))} random "
                f"ones{' for each pose' * (not optima.free)}, "
                f"seed {optima.seed}",
            ),
            ("Clearance", "not looked at" if optima.clearance is None else describe_shape(optima.clearance, optima.margin)),
        ],
        arm=optima.arm,
    )


def _draw_comparison(optima_rows: Optima, reference: str) -> list[tuple[str, list[Any]]]:
    from holdfast.interface.presentation.arm.view import scene
    from holdfast.interface.report.page import Picture

    pose_index = int(optima_rows.success.argmax())
    pose_note = "" if optima_rows.free else "; the tool is in the same place"
    caption = f"The arm at its best configuration and, see-through, at {reference}{pose_note}."
    configurations = np.array([optima_rows.q[pose_index], optima_rows.q_before[pose_index]])
    cell = None if optima_rows.clearance is None else optima_rows.clearance.cell
    comparison_scene = scene(
        optima_rows.arm,
        configurations,
        labels=("best", "before"),
        targets=[] if optima_rows.free else [optima_rows.poses[pose_index]],
        cell=cell,
    )
    return [
        (
            "Before and best",
            [
                Picture(
                    comparison_scene.to_html("both", caption),
                    caption + (f" Pose {pose_index + 1}." if len(optima_rows.poses) > 1 else ""),
                )
            ],
        )
    ]


def show(optima: Optima, out: Console, asked: str = "") -> None:
    """Print one pose joint by joint, or a line for each pose."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    optima_rows = optima.rows
    value_before = optima_rows.value_before
    unit = "" if optima.objective.unit in ("1", "mixed") else f" {escape(optima.objective.unit)}"
    reference = _name_reference(optima)
    failure_text = _format_failures(optima)
    objective_text = (asked or _describe_objective(optima)) + ("" if failure_text is None else f" over failures {failure_text}")
    title = f"{objective_text}, arm {optima.arm.title}, task {optima.task.describe()}"
    out.print(escape(title), soft_wrap=True)
    if len(optima_rows.poses) == 1:
        _show_single_pose(optima_rows, out, reference, unit)
    else:
        table = BandedTable("pose", f"before{unit}", f"after{unit}", "starts agreeing", "")
        for pose_index, status in enumerate(optima_rows.status):
            agreeing = (
                ""
                if np.isnan(optima_rows.agreeing[pose_index])
                else f"{optima_rows.agreeing[pose_index]:.0%} of {optima_rows.starts[pose_index]}"
            )
            status_text = "" if status == Status.OK else _status_name(status).replace("_", " ")
            table.add_row(
                str(pose_index + 1),
                format_significant(value_before[pose_index], 6),
                format_significant(optima_rows.value[pose_index], 6),
                agreeing,
                status_text,
            )
        out.print(table)
        out.print(f"before: the {reference}; configurations go to --csv FILE or --json", soft_wrap=True)
    _show_clearance(optima_rows, out)
    for status in sorted({int(status_code) for status_code in optima_rows.status if status_code != Status.OK}):
        out.print(f"[yellow]{_status_name(status).replace('_', ' ')}: {Status(status).sentence}[/]", soft_wrap=True)
    if optima.cap is not None:
        out.print(f"[yellow]{escape(_compose_cap_advice(optima))}[/]", soft_wrap=True)
    if optima.initial is not None and optima_rows.worse.any():
        pose_count = "" if len(optima_rows.poses) == 1 else f" of {int(optima_rows.worse.sum())} poses"
        out.print(
            f"[yellow]The configuration given{pose_count} is better than any found; give more --starts.[/]", soft_wrap=True
        )


def _show_single_pose(optima_rows: Optima, out: Console, reference: str, unit: str) -> None:
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    before = optima_rows.q_before[0]
    out.print(
        f"[bold]{format_significant(optima_rows.value[0], 6)}{unit}[/], {optima_rows.objective.better} wanted; "
        f"{format_significant(optima_rows.value_before[0], 6)} before (the {reference})",
        soft_wrap=True,
    )
    measures = list(_compare_measures(optima_rows))
    columns = [f"{escape(label)} {moment}" for label, *_ in measures for moment in ("before", "after")]
    table = BandedTable("joint", "before", "after", *columns)
    joint_units = [joint.unit for joint in optima_rows.arm.joints]
    value_columns = [
        (joint_units, before),
        (joint_units, optima_rows.q[0]),
        *((units, joint_values[0]) for _, units, *value_pair in measures for joint_values in value_pair),
    ]
    for name, *cells in zip(
        optima_rows.arm.joint_names,
        *(format_positions(joint_values, units) for units, joint_values in value_columns),
        strict=True,
    ):
        table.add_row(escape(name), *cells)
    out.print(table)
    print_limit_violations(optima_rows.arm, before, out, " before")
    agreeing = optima_rows.agreeing[0]
    advice = "" if agreeing >= MANY_AGREEING_FRACTION else "; there are many optima: more --starts may find a better one"
    start_phrase = "were climbed from" if optima_rows.free else "met the pose"
    out.print(
        f"{optima_rows.starts[0]} starts {start_phrase}; of those followed to the end {agreeing:.0%} agree{advice}",
        soft_wrap=True,
    )
    if optima_rows.status[0] == Status.OK and not optima_rows.free:
        out.print(
            f"pose met to {optima_rows.position_error[0]:.1e} m and {optima_rows.rotation_error[0]:.1e} rad", soft_wrap=True
        )


def _show_clearance(optima_rows: Optima, out: Console) -> None:
    """Print the clearance of the arm, and the better configurations that were rejected because they are too close."""
    from rich.markup import escape

    if optima_rows.clearance is None:
        return
    before, after = optima_rows.clearance_at(optima_rows.q_before), optima_rows.clearance_at(optima_rows.q)
    collision_phrase, blocked = optima_rows.clearance.too_close(optima_rows.margin), int(optima_rows.blocked.sum())
    if len(before) == 1:
        distance_text = ", ".join(
            f"{format_significant(distances[0], 3)} m {moment}"
            for distances, moment in ((before, "before"), (after, "after"))
            if distances[0] == distances[0]
        )
        text = f"clearance of the arm from {optima_rows.clearance.everything}: {distance_text}"
        text += f"; a better configuration {collision_phrase} and was not taken: {optima_rows.obstacles[0]}" if blocked else ""
    else:
        counts = [int(optima_rows.close(distances).sum()) for distances in (optima_rows.q_before, optima_rows.q)]
        text = (
            f"the arm {collision_phrase} in {counts[0]} of {len(before)} configurations before, in {counts[1] or 'none'} after"
        )
        text += f"; at {blocked} poses a better configuration does and was not taken" if blocked else ""
    out.print(escape(f"{text} ({describe_shape(optima_rows.clearance, optima_rows.margin)})"), soft_wrap=True)


def to_csv(optima: Optima, path: Path) -> Path:
    """Write the configurations as rows of a table."""
    optima_rows = optima.rows
    names = [f"{joint.name}_{joint.unit}" for joint in optima_rows.arm.joints]
    columns = ["pose", "status", "value_before", "value", "starts", "agreeing", "position_error_m", "rotation_error_rad"]
    facts = (
        optima_rows.value_before,
        optima_rows.value,
        optima_rows.starts,
        optima_rows.agreeing,
        optima_rows.position_error,
        optima_rows.rotation_error,
    )
    rows = np.column_stack([*facts, optima_rows.q])
    with open_replacement(path, "configurations") as file:
        table = csv.writer(file)
        table.writerow(map(escape_formula, columns + names))
        for index, row in enumerate(rows):
            table.writerow([index + 1, _status_name(optima_rows.status[index]), *[f"{entry:.12g}" for entry in row]])
    return path


def _format_failures(optima: Optima) -> str | None:
    """Format the failures of an index for --failures; None where they are those of each joint alone."""
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


def _compose_cap_advice(optima: Optima) -> str:
    assert optima.cap is not None
    return f"{optima.cap}. To optimise without it: --failures '{_format_remaining_failures(optima)}'."


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
