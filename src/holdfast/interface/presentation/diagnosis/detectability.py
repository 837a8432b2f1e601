"""Text, tables, and JSON of the predicted detectability of locks, and of the evaluation of a record."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.response.diagnosis.detectability.observability import Observability
from holdfast.response.diagnosis.detectability.probe import Identification, ProbingMotion

SEPARATION_CAPTION = (
    "Which locks can be told apart",
    "Two explanations of the tool's pose, in nats: how much more likely the true one becomes by this motion. Below 9.2, a "
    "factor of 10,000, the two are not told apart; the colour ends at three times that. None: no joint is locked.",
)


def to_dict(result: Observability | ProbingMotion | Identification) -> dict[str, Any]:
    """Return for each joint its detectability and the locks that cannot be distinguished; or the decision."""
    if isinstance(result, Identification):
        return {
            "joint": result.joint,
            "remaining": list(result.remaining),
            "cleared": list(result.cleared),
            "time_s": result.time,
            "tool_displacement_m": result.displacement,
        }
    data: dict[str, Any] = {
        **result.arm.entry(),
        "separation_nats": result.separation,
        "together": list(map(list, result.inseparable)),
    }
    if isinstance(result, Observability):
        return {
            **data,
            "duration_s": result.duration,
            "not_shown": list(result.unseen),
            "delays_s": result.delays,
            "locked_or_free_swinging": result.alike,
        }
    return {
        **data,
        "task": result.task.name,
        "duration_s": result.t[-1],
        "suspects": [result.arm.joint_names[joint] for joint in result.suspects],
        "told_apart": list(result.isolable),
        "not_testable": list(result.untestable),
        "largest_rates": result.visible,
        "tool_strays_m": result.tool,
    }


def tables(result: Observability | ProbingMotion | Identification) -> list[TextTable]:
    """Tabulate the joints, one row for each."""
    if isinstance(result, Identification):
        rows = [[name, "possible"] for name in result.remaining] + [[name, "not locked"] for name in result.cleared]
        return [TextTable(["locked joint", "after the record"], rows, "what the tool's pose says")]
    names, unseen = result.arm.joint_names, result.untestable if isinstance(result, ProbingMotion) else result.unseen
    distinguishable = dict.fromkeys(names, "yes") | {name: "not from all" for locks in result.inseparable for name in locks}
    distinguishable |= dict.fromkeys(unseen, "no")
    nearest_separation = np.array([np.delete(row, row_index).min() for row_index, row in enumerate(result.separation)][1:])
    if isinstance(result, ProbingMotion):
        rows = [
            [
                names[joint],
                format_significant(result.visible[joint], 2),
                format_significant(nearest_separation[joint], 3),
                distinguishable[names[joint]],
            ]
            for joint in result.suspects
        ]
        return [TextTable(["joint", "largest rate", "nats to the nearest", "told apart"], rows, "suspects")]
    rows = [[name, format_significant(nearest_separation[joint], 3), distinguishable[name]] for joint, name in enumerate(names)]
    return [TextTable(["joint", "nats to the nearest", "told apart by the tool's pose"], rows, "locks")]


def key_table(result: Observability | ProbingMotion | Identification) -> TextTable:
    """Return the table of the joints."""
    return tables(result)[0]


def story(result: Observability | ProbingMotion) -> PageContent:
    """Compose the report of a predicted or planned motion."""
    headline, *remarks = result.describe()
    is_probe = isinstance(result, ProbingMotion)
    return PageContent(
        "A self-motion that tells which joint is locked" if is_probe else "What a motion shows of locked joints",
        f"{capitalise_first(headline)}.",
        about=result.arm.title,
        lines=[f"{capitalise_first(line)}." for line in remarks],
        figures={"separation": SEPARATION_CAPTION},
        arm=result.arm,
    )
