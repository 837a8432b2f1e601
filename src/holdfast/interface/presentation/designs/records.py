"""Numbers and text of records and their checks."""

from __future__ import annotations

from typing import Any

from holdfast.core.formatting import format_percent
from holdfast.interface.presentation.printing import TextTable
from holdfast.studies.designs.record_book.entries import DesignRecord, RecordBook, RecordCheck

BookResult = RecordBook | DesignRecord | RecordCheck

_RECORD_HEADER = ["record", "task", "joints", "locked", "value", "no arm can beat", "by", "gap"]


def format_record_row(record: DesignRecord) -> list[str]:
    """Format a record as a row of a table."""
    kind, bound = record.data.kind, record.data.proven_bound
    task_text, gap_text = kind.task or f"any of {kind.rows} rows", "0" if record.gap < 1e-8 else format_percent(record.gap)
    return [record.id, task_text, f"{kind.joints}", f"{kind.failures}", record.amount, f"{bound.value:.7g}", bound.by, gap_text]


def to_dict(result: BookResult) -> dict[str, Any]:
    """Return the content of the file, or the claims of a check, as JSON data."""
    if isinstance(result, RecordBook):
        return {"records": [to_dict(record) for record in result.values()]}
    if isinstance(result, DesignRecord):
        return result.data.model_dump(by_alias=True, exclude_none=True)
    return {
        "record": result.record.id,
        "ok": result.ok,
        "claims": [{"said": claim, "holds": holds} for claim, holds in result.claims],
    }


def tables(result: BookResult) -> list[TextTable]:
    """Return a row for each record."""
    if isinstance(result, RecordBook):
        return [TextTable(_RECORD_HEADER, [format_record_row(item) for item in result.values()])]
    return []


def key_table(result: BookResult) -> TextTable:
    """Return a row for each record or claim, for notebooks."""
    if isinstance(result, DesignRecord):
        return TextTable(_RECORD_HEADER, [format_record_row(result)])
    if isinstance(result, RecordCheck):
        return TextTable(["claim", "holds"], [[claim, "yes" if holds else "no"] for claim, holds in result.claims])
    return tables(result)[0]


def next_steps(result: BookResult, name: str) -> list[str]:
    """Suggest a use of the result."""
    if isinstance(result, RecordBook):
        return [f'{name}["pose-9R-k2-001"].check()  # measures it again']
    if isinstance(result, DesignRecord):
        return [f"{name}.check()  # measures it again"]
    return [f"{name}.ok  # every claim holds"]
