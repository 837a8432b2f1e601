"""Text, tables, and JSON of fault episodes."""

from __future__ import annotations

from typing import Any

from holdfast.interface.presentation.printing import TextTable
from holdfast.response.faults.batch import FaultBatch


def to_dict(batch: FaultBatch) -> dict[str, Any]:
    """Return the events of each episode with the digest that identifies them."""
    return {
        "joints": list(batch.joints),
        "seed": batch.seed,
        "episodes": [
            {"episode": batch.first + index, "id": events.id, "events": [event.to_stored() for event in events]}
            for index, events in enumerate(batch.episodes)
        ],
    }


def tables(batch: FaultBatch) -> list[TextTable]:
    """Tabulate the faults, one row for each."""
    rows = []
    for index, events in enumerate(batch.episodes):
        for sentence in [event.sentence() for event in events] or ["no fault"]:
            rows.append([str(batch.first + index), events.id[:12], sentence])
    return [TextTable(["episode", "id", "fault"], rows)]


def key_table(batch: FaultBatch) -> TextTable:
    """Return the table of the faults."""
    return tables(batch)[0]
