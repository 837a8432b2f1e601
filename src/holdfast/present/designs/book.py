"""The record book as a folder: a page with value, bound, gap and picture of each record, and what can be downloaded."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from holdfast.designs.book.entries import Book, Record
from holdfast.files.output import put
from holdfast.notice import says
from holdfast.report import figures as drawing
from holdfast.report import page
from holdfast.report.page import Cell, Page, Picture, Section, Table, Text
from holdfast.report.palette import BLUE, FAINT, INK, ORANGE
from holdfast.words import percent

PAGE = "records.html"
_AXIS = 0.09  # length of a joint's axis that is drawn, of the picture's width
_COLUMNS = 4
_CAPTION = "Each arm at its configuration: links in blue, joint axes in orange, the tool as a dot."
_KINDS = {"planar": "Planar arms", "position": "Arms for positions", "pose": "Arms for poses"}


@says("writing the results")
def save(book: Book, folder: Path, command: str = "") -> list[Path]:
    """The YAML file of each record, the URDF file of each arm, and records.html."""
    arms = {f"{r.id}.urdf": r.urdf() for r in book.values() if r.arm is not None}
    return [*put(folder, {f"{r.id}.yaml": r.text for r in book.values()} | arms), write(book, folder / PAGE, command)]


@says("drawing the report")
def write(book: Book, path: Path, command: str = "") -> Path:
    """The page; its links are to the files of :func:`save` beside it."""
    bare = [r for r in book.values() if r.arm is None]
    sections = []
    for task, title in _KINDS.items():
        mine = [r for r in book.values() if r.arm is not None and r.data.kind.of is None and r.data.kind.task == task]
        with drawing.style():
            picture = drawing.svg(figure(mine), task, f"Stick figures of {len(mine)} arms")
        sections.append(Section(title, [_table(mine), Picture(picture, _CAPTION)]))
    sold = [r for r in book.values() if r.data.kind.of is not None]
    said = Text("The best configuration found of each, within its limits, beside what no arm of so many joints can beat.")
    sections.append(Section("Arms that are sold", [said, _table(sold)]))
    told = Text("A null space is that of arms of every kind: only the number of joints and of rows counts.")
    sections.append(Section("Null spaces alone", [told, _table(bare)]))
    open_ = sum(r.gap > 1e-8 for r in bare)
    made = Page(
        "Record book",
        f"{len(book)} records: the best that anybody has found. Of {open_} of {len(bare)} null spaces the value is below the "
        "proven bound: those are open.",
        sections,
        subtitle="What is left of an arm or its workspace after the worst locks, or how far its joints turn on one self-motion",
        method=[
            Text("Each record is one file, checked by code that shares nothing with what found it: holdfast records check.")
        ],
        again=command or "holdfast records check --all",
    )
    return page.write(made, path)


def _table(records: list[Record]) -> Table:
    head = ["record", "joints", "locked", "value", "no arm can beat", "by", "gap", "files"]
    return Table([_cells(r) for r in records], head, frozenset({1, 2, 3, 4}), wide=True)


def _cells(r: Record) -> list[Cell]:
    c, bound = r.data.kind, r.data.proven_bound
    gap = "0" if r.gap < 1e-8 else percent(r.gap)
    bar = Markup('<svg width="60" height="10" role="img" aria-label="{}"><rect width="60" height="10" fill="{}"/>').format(
        f"{percent(1 / (1 + r.gap))} of the bound", FAINT
    )
    bar += Markup('<rect width="{}" height="10" fill="{}"/></svg> {}').format(f"{60 / (1 + max(r.gap, 0)):.1f}", BLUE, gap)
    kinds = ["yaml", *(["urdf"] if r.arm is not None else [])]
    files = Markup(" ").join(Markup('<a href="{}.{}" download>{}</a>').format(r.id, kind, kind.upper()) for kind in kinds)
    return [r.id, f"{c.joints}", f"{c.failures}", r.amount, f"{bound.value:.8g}", bound.by, bar, files]


def figure(records: Sequence[Record]) -> Figure:
    """Arms as sticks, each seen so that it looks widest."""
    rows = -(-len(records) // _COLUMNS)
    drawn = Figure(figsize=(10, 2.5 * rows), layout="constrained")
    every = drawn.subplots(rows, _COLUMNS, squeeze=False).ravel()
    for axes in every:
        axes.set_axis_off()
    for axes, record in zip(every, records, strict=False):
        _sticks(axes, record)
    return drawn


def _sticks(axes: Axes, r: Record) -> None:
    arm = r.arm
    assert arm is not None
    frames = arm.frames(r.q)
    points = frames[:, :3, 3]
    middle = points.mean(axis=0)
    across = np.eye(3)[:2] if r.data.kind.task == "planar" else np.linalg.svd(points - middle)[2][:2]
    places = (points - middle) @ across.T
    width = max(float(np.ptp(places, axis=0).max()), 1e-6)
    axes.plot(*places.T, color=BLUE, linewidth=2.5, solid_capstyle="round")
    for place, frame, joint in zip(places[1:-1], frames[1:-1], arm.joints, strict=True):
        half = _AXIS * width * (frame[:3, :3] @ joint.axis @ across.T)
        axes.plot(*np.stack([place - half, place + half]).T, color=ORANGE, linewidth=1.6)
        axes.plot(*place, "o", color=ORANGE, markersize=3)
    axes.plot(*places[-1], "o", color=INK, markersize=5)
    center = (places.max(axis=0) + places.min(axis=0)) / 2
    for side, at in zip((axes.set_xlim, axes.set_ylim), center, strict=True):
        side(at - 0.6 * width, at + 0.6 * width)
    axes.set_aspect("equal")
    axes.set_title(f"{drawing.plain(r.id)}\n{width:.2g} m wide", fontsize=7)
