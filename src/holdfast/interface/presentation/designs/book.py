"""Sections of the page of the record book, with a drawing and the files of each record."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from markupsafe import Markup

from holdfast.interface import report
from holdfast.interface.presentation.presentation import TableSpec
from holdfast.interface.report.page import Picture, Section, Table, Text
from holdfast.interface.report.palette import BLUE, INK, ORANGE
from holdfast.studies.designs.record_book.entries import DesignRecord, RecordBook

Tabulate = Callable[[Sequence[DesignRecord]], TableSpec]
_AXIS_LENGTH_FRACTION = 0.09  # half length of a drawn joint axis, as a fraction of the width of the drawing
_COLUMN_COUNT = 4
_PICTURE_CAPTION = "Each arm at its configuration: links in blue, joint axes in orange, the tool as a dot."
_TITLES_BY_TASK = {"planar": "Planar arms", "position": "Arms for position tasks", "pose": "Arms for pose tasks"}


def build_sections(book: RecordBook, tabulate: Tabulate) -> list[Section]:
    """Build a section for each task, for commercial arms, and for null spaces; ``tabulate`` builds the table of a section."""
    sections, arm_records = [], [record for record in book.values() if record.arm is not None]
    for task, title in _TITLES_BY_TASK.items():
        records = [record for record in arm_records if record.data.kind.of is None and record.data.kind.task == task]
        with report.style():
            picture = report.svg(draw_stick_figures(records), task, f"Stick figures of {len(records)} arms")
        sections.append(Section(title, [_build_table(records, tabulate), Picture(picture, _PICTURE_CAPTION)]))
    commercial_text = Text(
        "The best configuration found of each arm within its joint limits, and the upper bound for arms with as many joints."
    )
    commercial_records = [record for record in arm_records if record.data.kind.of is not None]
    sections.append(Section("Commercial arms", [commercial_text, _build_table(commercial_records, tabulate)]))
    null_space_text = Text("A null space is independent of the kind of arm: only the numbers of joints and task rows matter.")
    null_spaces = [record for record in book.values() if record.arm is None]
    return [*sections, Section("Null spaces", [null_space_text, _build_table(null_spaces, tabulate)])]


def _build_table(records: Sequence[DesignRecord], tabulate: Tabulate) -> Table:
    """Build the table of records with links to their files."""
    texts = tabulate(records).texts()
    rows = []
    for record, cells in zip(records, texts.rows, strict=True):
        links = Markup(" ").join(
            Markup('<a href="{}.{}" download>{}</a>').format(record.id, kind, kind.upper())
            for kind in ("yaml", "urdf")
            if kind == "yaml" or record.arm is not None
        )
        rows.append([*cells, links])
    return Table(rows, [*texts.head, "files"], frozenset({2, 3, 4, 5, 7}), wide=True)


def draw_stick_figures(records: Sequence[DesignRecord]) -> report.Figure:
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
