"""Record book as a folder: a page with value, bound, gap and picture of each record, and the files to download."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from holdfast.core.files.output import write_files
from holdfast.core.formatting import format_percent
from holdfast.core.progress import reports_progress
from holdfast.interface.report import figures as drawing
from holdfast.interface.report import page
from holdfast.interface.report.page import Cell, Page, Picture, Section, Table, Text
from holdfast.interface.report.palette import BLUE, FAINT, INK, ORANGE
from holdfast.studies.designs.record_book.entries import DesignRecord, RecordBook

PAGE_FILE = "records.html"
_AXIS_LENGTH_FRACTION = 0.09  # length of a joint's axis that is drawn, of the picture's width
_COLUMN_COUNT = 4
_PICTURE_CAPTION = "Each arm at its configuration: links in blue, joint axes in orange, the tool as a dot."
_TITLES_BY_TASK = {"planar": "Planar arms", "position": "Arms for positions", "pose": "Arms for poses"}


@reports_progress("writing the results")
def save(book: RecordBook, folder: Path, command: str = "") -> list[Path]:
    """Save the YAML file of each record, the URDF file of each arm, and records.html."""
    urdf_files = {f"{record.id}.urdf": record.urdf() for record in book.values() if record.arm is not None}
    return [
        *write_files(folder, {f"{record.id}.yaml": record.text for record in book.values()} | urdf_files),
        write(book, folder / PAGE_FILE, command),
    ]


@reports_progress("drawing the report")
def write(book: RecordBook, path: Path, command: str = "") -> Path:
    """Write the page of the record book, whose links lead to the files of :func:`save` in the same folder."""
    null_spaces = [record for record in book.values() if record.arm is None]
    sections = []
    for task, title in _TITLES_BY_TASK.items():
        task_records = [
            record
            for record in book.values()
            if record.arm is not None and record.data.kind.of is None and record.data.kind.task == task
        ]
        with drawing.style():
            picture = drawing.svg(draw_stick_figures(task_records), task, f"Stick figures of {len(task_records)} arms")
        sections.append(Section(title, [_tabulate_records(task_records), Picture(picture, _PICTURE_CAPTION)]))
    commercial_records = [record for record in book.values() if record.data.kind.of is not None]
    commercial_text = Text(
        "The best configuration found of each, within its limits, beside what no arm of so many joints can beat."
    )
    sections.append(Section("Arms that are sold", [commercial_text, _tabulate_records(commercial_records)]))
    null_space_text = Text("A null space is that of arms of every kind: only the number of joints and of rows counts.")
    sections.append(Section("Null spaces alone", [null_space_text, _tabulate_records(null_spaces)]))
    open_count = sum(record.gap > 1e-8 for record in null_spaces)
    report = Page(
        "Record book",
        f"{len(book)} records: the best that anybody has found. Of {open_count} of {len(null_spaces)} null spaces the "
        f"value is below the "
        "proven bound: those are open.",
        sections,
        subtitle="What is left of an arm or its workspace after the worst locks, or how far its joints turn on one self-motion",
        method=[Text("Each record is one file and is checked by independent code: holdfast record-designs check.")],
        again=command or "holdfast record-designs check --all",
    )
    return page.write(report, path)


def _tabulate_records(records: list[DesignRecord]) -> Table:
    header = ["record", "joints", "locked", "value", "no arm can beat", "by", "gap", "files"]
    return Table([_format_record_cells(record) for record in records], header, frozenset({1, 2, 3, 4}), wide=True)


def _format_record_cells(record: DesignRecord) -> list[Cell]:
    kind, bound = record.data.kind, record.data.proven_bound
    gap_text = "0" if record.gap < 1e-8 else format_percent(record.gap)
    gap_bar = Markup('<svg width="60" height="10" role="img" aria-label="{}"><rect width="60" height="10" fill="{}"/>').format(
        f"{format_percent(1 / (1 + record.gap))} of the bound", FAINT
    )
    gap_bar += Markup('<rect width="{}" height="10" fill="{}"/></svg> {}').format(
        f"{60 / (1 + max(record.gap, 0)):.1f}", BLUE, gap_text
    )
    file_kinds = ["yaml", *(["urdf"] if record.arm is not None else [])]
    links = Markup(" ").join(
        Markup('<a href="{}.{}" download>{}</a>').format(record.id, file_kind, file_kind.upper()) for file_kind in file_kinds
    )
    return [record.id, f"{kind.joints}", f"{kind.failures}", record.amount, f"{bound.value:.8g}", bound.by, gap_bar, links]


def draw_stick_figures(records: Sequence[DesignRecord]) -> Figure:
    """Draw arms as stick figures, each seen from the direction in which it looks widest."""
    row_count = -(-len(records) // _COLUMN_COUNT)
    picture = Figure(figsize=(10, 2.5 * row_count), layout="constrained")
    panels = picture.subplots(row_count, _COLUMN_COUNT, squeeze=False).ravel()
    for axes in panels:
        axes.set_axis_off()
    for axes, record in zip(panels, records, strict=False):
        _draw_stick_figure(axes, record)
    return picture


def _draw_stick_figure(axes: Axes, record: DesignRecord) -> None:
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
    axes.set_title(f"{drawing.format_label(record.id)}\n{width:.2g} m wide", fontsize=7)
