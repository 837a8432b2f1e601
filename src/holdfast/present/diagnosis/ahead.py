"""What a motion or a self-motion will show of locks, and what a record of one showed, in numbers and words."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.diagnosis.foresight.observability import Observability
from holdfast.diagnosis.foresight.probe import Finding, Probe
from holdfast.present.printing import Rows, number
from holdfast.present.story import Story
from holdfast.words import capitalised

MAP = (
    "Which locks can be told apart",
    "Two explanations of the tool's pose, in nats: how much more likely the true one becomes by this motion. Below 9.2, a "
    "factor of 10,000, the two are not told apart; the colour ends at three times that. None: no joint is locked.",
)


def to_dict(found: Observability | Probe | Finding) -> dict[str, Any]:
    """By joint what is seen and what stays together; or the decision."""
    if isinstance(found, Finding):
        return {
            "joint": found.joint,
            "remaining": list(found.remaining),
            "cleared": list(found.cleared),
            "time_s": found.time,
            "tool_displacement_m": found.displacement,
        }
    data: dict[str, Any] = {
        **found.arm.entry(),
        "separation_nats": found.separation,
        "together": list(map(list, found.together)),
    }
    if isinstance(found, Observability):
        return {
            **data,
            "duration_s": found.duration,
            "not_shown": list(found.unseen),
            "delays_s": found.delays,
            "locked_or_free_swinging": found.alike,
        }
    return {
        **data,
        "task": found.task.name,
        "duration_s": found.t[-1],
        "suspects": [found.arm.joint_names[i] for i in found.suspects],
        "told_apart": list(found.told_apart),
        "not_testable": list(found.untestable),
        "largest_rates": found.visible,
        "tool_strays_m": found.tool,
    }


def tables(found: Observability | Probe | Finding) -> list[Rows]:
    """A row for each joint."""
    if isinstance(found, Finding):
        rows = [[name, "possible"] for name in found.remaining] + [[name, "not locked"] for name in found.cleared]
        return [Rows(["locked joint", "after the record"], rows, "what the tool's pose says")]
    names, unseen = found.arm.joint_names, found.untestable if isinstance(found, Probe) else found.unseen
    told = dict.fromkeys(names, "yes") | {name: "not from all" for pair in found.together for name in pair}
    told |= dict.fromkeys(unseen, "no")
    least = np.array([np.delete(row, k).min() for k, row in enumerate(found.separation)][1:])
    if isinstance(found, Probe):
        rows = [[names[i], number(found.visible[i], 2), number(least[i], 3), told[names[i]]] for i in found.suspects]
        return [Rows(["joint", "largest rate", "nats to the nearest", "told apart"], rows, "suspects")]
    rows = [[name, number(least[i], 3), told[name]] for i, name in enumerate(names)]
    return [Rows(["joint", "nats to the nearest", "told apart by the tool's pose"], rows, "locks")]


def key_table(found: Observability | Probe | Finding) -> Rows:
    """The joints."""
    return tables(found)[0]


def next_steps(found: Observability | Probe | Finding, name: str) -> list[str]:
    """Look at the separations; record the motion."""
    if isinstance(found, Finding):
        return [f"{name}.remaining"]
    if isinstance(found, Probe):
        return [f"{name}.plot()", f"{name}.to_csv('probe.csv')", f"{name}.at(1000.0)"]
    return [f"{name}.plot()", f"{name}.unseen"]


def story(found: Observability | Probe) -> Story:
    """What the page says."""
    first, *others = found.describe()
    probe = isinstance(found, Probe)
    return Story(
        "A self-motion that tells which joint is locked" if probe else "What a motion shows of locked joints",
        f"{capitalised(first)}.",
        about=found.arm.title,
        lines=[f"{capitalised(line)}." for line in others],
        figures={"separation": MAP},
        arm=found.arm,
    )
