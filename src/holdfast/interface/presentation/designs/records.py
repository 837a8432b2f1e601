"""Presentation of record designs, their checks, and the record book."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Any

from holdfast.core.files.output import write_files
from holdfast.core.formatting import format_percent
from holdfast.interface.presentation import renderers
from holdfast.interface.presentation.designs.book import build_sections
from holdfast.interface.presentation.presentation import Header, Notice, Presentation, TableSpec
from holdfast.studies.designs.record_book.entries import (
    TOTAL_LINK_LENGTH_M,
    DesignRecord,
    RecordBook,
    RecordCheck,
    find_best_record,
)

PAGE_FILE = "records.html"
_ZERO_GAP = 1e-8  # relative gap that is due to rounding


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
        sections=partial(build_sections, result, _tabulate_records),
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
    return TableSpec("", [Header("said", "claim"), Header("holds", "holds")], check.claims)


def _tabulate_records(records: Iterable[DesignRecord], on_page: bool = True) -> TableSpec:
    """Tabulate records, a row for each."""
    keys = ("record", "task", "joints", "locked", "value", "bound", "by", "gap")
    columns = [Header(key, "upper bound" if key == "bound" else key) for key in keys]
    rows = []
    for record in records:
        kind, bound = record.data.kind, record.data.proven_bound
        task_text, gap_text = kind.task or f"any of {kind.rows} rows", _format_gap(record)
        bound_text = f"{bound.value:.7g}"
        rows.append([record.id, task_text, kind.joints, kind.failures, record.amount, bound_text, bound.by, gap_text])
    return TableSpec("", columns, rows, on_page=on_page)


def _format_gap(record: DesignRecord) -> str:
    return "0" if record.gap < _ZERO_GAP else format_percent(record.gap)


def save(result: RecordBook | DesignRecord | RecordCheck, folder: Path, command: str = "") -> list[Path]:
    """Save the page; for the book, also the YAML file of each record and the URDF file of each arm, which the page links."""
    if not isinstance(result, RecordBook):
        return renderers.save(result, folder, command)
    files = {f"{record.id}.yaml": record.text for record in result.values()}
    files |= {f"{record.id}.urdf": record.urdf() for record in result.values() if record.arm is not None}
    written = write_files(folder, files)
    page_file: Path = renderers.write(result, folder / PAGE_FILE, command or "holdfast record-designs check --all")
    return [*written, page_file]
