"""Presentation of record designs, their checks, and the record book."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup

from holdfast.core.files.output import write_files
from holdfast.core.formatting import format_percent
from holdfast.interface import report
from holdfast.interface.presentation import renderers
from holdfast.interface.presentation.presentation import Header, Notice, Presentation, TableSpec
from holdfast.interface.report.page import Picture, Section, Table, Text
from holdfast.interface.report.palette import BLUE, INK, ORANGE
from holdfast.studies.designs.record_book.entries import (
    TOTAL_LINK_LENGTH_M,
    DesignRecord,
    RecordBook,
    RecordCheck,
    find_best_record,
)

PAGE_FILE = "records.html"
_ZERO_GAP = 1e-8  # relative gap that is due to rounding
_AXIS_LENGTH_FRACTION = 0.09  # half length of a drawn joint axis, as a fraction of the width of the drawing
_COLUMN_COUNT = 4
_PICTURE_CAPTION = "Each arm at its configuration: links in blue, joint axes in orange, the tool as a dot."
_TITLES_BY_TASK = {"planar": "Planar arms", "position": "Arms for position tasks", "pose": "Arms for pose tasks"}


def to_dict(result: RecordBook | DesignRecord | RecordCheck) -> dict[str, Any]:
    """Return the content of the file, or the claims of a check, as JSON data."""
    if isinstance(result, RecordBook):
        return {"records": [to_dict(record) for record in result.values()]}
    if isinstance(result, DesignRecord):
        return result.data.model_dump(by_alias=True, exclude_none=True)
    return {"record": result.record.id, "ok": result.ok, "claims": _tabulate_claims(result).records()}


def present(result: RecordBook | DesignRecord | RecordCheck) -> Presentation:
    """Present the value and the bound of a record or of all records, or the claims of a check."""
    if isinstance(result, RecordCheck):
        return _present_check(result)
    if isinstance(result, DesignRecord):
        return Presentation(f"Record {result.id}", _describe_record(result), tables=[_tabulate_records([result])])
    null_spaces = [record for record in result.values() if record.arm is None]
    open_count = sum(record.gap > _ZERO_GAP for record in null_spaces)
    answer = (
        f"{len(result)} records, each the best value found so far. For {open_count} of {len(null_spaces)} null spaces the "
        "value is below the proved upper bound, so these cases are open."
    )
    return Presentation(
        "Record book",
        answer,
        about="Remaining manipulability or workspace after the worst locks, or number of joint revolutions in one self-motion",
        tables=[_tabulate_records(result.values(), on_page=False)],
        sections=partial(_build_sections, result),
        method=[("Checks", "Each record is one file and is checked by independent code: holdfast record-designs check.")],
    )


def _describe_record(record: DesignRecord) -> str:
    """Describe the class, the value, and the bound of a record in a sentence."""
    kind, bound = record.data.kind, record.data.proven_bound
    quantity_texts = {
        "relative-manipulability": f"{kind.failures} locked at once",
        "self-motion-size": "full revolutions in one self-motion",
        "tolerant-workspace": f"m^2 whichever joint locks, {TOTAL_LINK_LENGTH_M:g} m of links, each at least "
        f"{format_percent(kind.least_link)} of this length",
    }
    arm_prefix = "" if kind.of is None else f"{kind.of}, "
    class_text = (
        f"{arm_prefix}{kind.task or f'any task of {kind.rows} rows'}, {kind.joints} joints, {quantity_texts[kind.quantity]}"
    )
    beaten_text = f"; superseded by {record.data.beaten_by}" if record.data.beaten_by else ""
    value_text = f"{record.data.value:.10g}; no arm can exceed {bound.value:.10g} ({bound.by}){beaten_text}"
    return f"{record.id}: {class_text}: {value_text}."


def _present_check(check: RecordCheck) -> Presentation:
    """Present which claims hold, and compare the record with the current one of its class."""
    record, current, lines = check.record, find_best_record(check.record.data.kind), []
    if check.ok and current is None:
        lines.append("It is the first record of its class.")
    elif check.ok and current is not None and current.id != record.id:
        relative_gain = record.data.value / current.data.value - 1
        verb = "is better than" if relative_gain > 1e-9 else "is not better than"
        lines.append(f"It {verb} {current.id}: {100 * relative_gain:+.2g} %.")
    return Presentation(
        f"Check of record {record.id}",
        f"{record.id} {'passes' if check.ok else 'fails'} the check.",
        lines=lines,
        notices=[Notice(f"Does not hold: {claim}", "bad") for claim, holds in check.claims if not holds],
        tables=[_tabulate_claims(check)],
    )


def _tabulate_claims(check: RecordCheck) -> TableSpec:
    return TableSpec("", [Header("claim", key="said"), "holds"], check.claims)


def _tabulate_records(records: Iterable[DesignRecord], on_page: bool = True) -> TableSpec:
    """Tabulate records, a row for each."""
    columns = ["record", "task", "joints", "locked", "value", "upper bound", "by", "gap"]
    rows = []
    for record in records:
        kind, bound = record.data.kind, record.data.proven_bound
        task_text = kind.task or f"any of {kind.rows} rows"
        gap_text = "0" if record.gap < _ZERO_GAP else format_percent(record.gap)
        bound_text = f"{bound.value:.7g}"
        rows.append([record.id, task_text, kind.joints, kind.failures, record.amount, bound_text, bound.by, gap_text])
    return TableSpec("", columns, rows, on_page=on_page)


def save(result: RecordBook | DesignRecord | RecordCheck, folder: Path, command: str = "") -> list[Path]:
    """Save the page; for the book, also the YAML file of each record and the URDF file of each arm, which the page links."""
    if not isinstance(result, RecordBook):
        return renderers.save(result, folder, command)
    files = {f"{record.id}.yaml": record.text for record in result.values()}
    files |= {f"{record.id}.urdf": record.urdf() for record in result.values() if record.arm is not None}
    written = write_files(folder, files)
    page_file: Path = renderers.write(result, folder / PAGE_FILE, command or "holdfast record-designs check --all")
    return [*written, page_file]


# ---- page of the book ----------------------------------------------------------------------------------------------------


def _build_sections(book: RecordBook) -> list[Section]:
    """Build a section for each task, for commercial arms, and for null spaces."""
    sections, arm_records = [], [record for record in book.values() if record.arm is not None]
    for task, title in _TITLES_BY_TASK.items():
        records = [record for record in arm_records if record.data.kind.of is None and record.data.kind.task == task]
        with report.style():
            picture = report.svg(_draw_stick_figures(records), task, f"Stick figures of {len(records)} arms")
        sections.append(Section(title, [_build_table(records), Picture(picture, _PICTURE_CAPTION)]))
    commercial_text = Text(
        "The best configuration found of each arm within its joint limits, and the upper bound for arms with as many joints."
    )
    commercial_records = [record for record in arm_records if record.data.kind.of is not None]
    sections.append(Section("Commercial arms", [commercial_text, _build_table(commercial_records)]))
    null_space_text = Text("A null space is independent of the kind of arm: only the numbers of joints and task rows matter.")
    null_spaces = [record for record in book.values() if record.arm is None]
    return [*sections, Section("Null spaces", [null_space_text, _build_table(null_spaces)])]


def _build_table(records: Sequence[DesignRecord]) -> Table:
    """Build the table of records with links to their files."""
    texts = _tabulate_records(records).texts()
    rows = []
    for record, cells in zip(records, texts.rows, strict=True):
        links = Markup(" ").join(
            Markup('<a href="{}.{}" download>{}</a>').format(record.id, kind, kind.upper())
            for kind in ("yaml", "urdf")
            if kind == "yaml" or record.arm is not None
        )
        rows.append([*cells, links])
    return Table(rows, [*texts.head, "files"], frozenset({2, 3, 4, 5, 7}), wide=True)


def _draw_stick_figures(records: Sequence[DesignRecord]) -> report.Figure:
    """Draw arms as stick figures, each projected onto the plane in which it is widest."""
    row_count = -(-len(records) // _COLUMN_COUNT)
    picture = report.Figure(figsize=(10, 2.5 * row_count), layout="constrained")
    panels = picture.subplots(row_count, _COLUMN_COUNT, squeeze=False).ravel()
    for axes in panels:
        axes.set_axis_off()
    for axes, record in zip(panels, records, strict=False):
        _draw_stick_figure(axes, record)
    return picture


def _draw_stick_figure(axes: report.Axes, record: DesignRecord) -> None:
    arm = record.arm
    assert arm is not None
    frames = arm.frames(record.q)
    points = frames[:, :3, 3]
    centroid = points.mean(axis=0)
    view_axes = np.eye(3)[:2] if record.data.kind.task == "planar" else np.linalg.svd(points - centroid)[2][:2]
    positions = (points - centroid) @ view_axes.T
    width = max(float(np.ptp(positions, axis=0).max()), 1e-6)
    axes.plot(*positions.T, color=BLUE, linewidth=2.5, solid_capstyle="round")
    for position, frame, joint in zip(positions[1:-1], frames[1:-1], arm.joints, strict=True):
        half_axis = _AXIS_LENGTH_FRACTION * width * (frame[:3, :3] @ joint.axis @ view_axes.T)
        axes.plot(*np.stack([position - half_axis, position + half_axis]).T, color=ORANGE, linewidth=1.6)
        axes.plot(*position, "o", color=ORANGE, markersize=3)
    axes.plot(*positions[-1], "o", color=INK, markersize=5)
    center = (positions.max(axis=0) + positions.min(axis=0)) / 2
    for set_limits, middle_value in zip((axes.set_xlim, axes.set_ylim), center, strict=True):
        set_limits(middle_value - 0.6 * width, middle_value + 0.6 * width)
    axes.set_aspect("equal")
    axes.set_title(f"{report.format_label(record.id)}\n{width:.2g} m wide", fontsize=7)
