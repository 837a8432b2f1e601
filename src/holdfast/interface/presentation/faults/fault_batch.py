"""Presentation of fault episodes."""

from __future__ import annotations

from typing import Any

from holdfast.core.formatting import format_count
from holdfast.interface.presentation.presentation import Presentation, TableSpec
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


def present(batch: FaultBatch) -> Presentation:
    """Present the faults of each episode."""
    rows = [
        (batch.first + index, events.id[:12], sentence)
        for index, events in enumerate(batch.episodes)
        for sentence in [event.sentence() for event in events] or ["no fault"]
    ]
    fault_counts = [len(events) for events in batch.episodes]
    episodes = f"{format_count(len(fault_counts), 'episode')} (seed {batch.seed}); {fault_counts.count(0)} without a fault"
    omission = f"{batch.left_out} of the faults follow another fault of the same joint and are not in the arrays."
    return Presentation(
        "Sampled faults",
        f"{sum(fault_counts)} faults in {episodes}.",
        lines=[omission] if batch.left_out else [],
        tables=[TableSpec("Faults", ["episode", "id", "fault"], rows)],
    )
