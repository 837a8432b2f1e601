"""Episodes of faults in numbers and words."""

from __future__ import annotations

from typing import Any

from holdfast.faults.batch import FaultBatch
from holdfast.present.printing import Rows


def to_dict(batch: FaultBatch) -> dict[str, Any]:
    """The events of each episode with the digest that names them."""
    return {
        "joints": list(batch.joints),
        "seed": batch.seed,
        "episodes": [
            {"episode": batch.first + k, "id": events.id, "events": [event.stored() for event in events]}
            for k, events in enumerate(batch.episodes)
        ],
    }


def tables(batch: FaultBatch) -> list[Rows]:
    """A row for each fault."""
    rows = []
    for k, events in enumerate(batch.episodes):
        for sentence in [event.sentence() for event in events] or ["no fault"]:
            rows.append([str(batch.first + k), events.id[:12], sentence])
    return [Rows(["episode", "id", "fault"], rows)]


def key_table(batch: FaultBatch) -> Rows:
    """The faults."""
    return tables(batch)[0]


def next_steps(batch: FaultBatch, name: str) -> list[str]:
    """One episode, and the arrays."""
    return [f"{name}.episodes[{min(1, len(batch) - 1)}]", f"{name}.onset"]
