"""Which arm for what: of each question that a study answers, how the arms stand, and whether the first is really ahead."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from holdfast.assess.structure import Structure, structure
from holdfast.interval import Interval
from holdfast.report.words import as_given
from holdfast.studies.results import Assessed, Driven

Key = tuple[str, str]  # index and task

# Of a Jacobian that has lost rank; a mean of singular values is not 0 then.
_WORST_IF_SINGULAR = {
    *(
        "relative-manipulability",
        "manipulability",
        "minimum-singular-value",
        "geometric-mean-singular-value",
        "condition-number",
    )
}


@dataclass(frozen=True)
class Standing:
    """How the arms stand at one question.

    Attributes:
        question: For people, short.
        about: What is counted, of how many.
        entries: Name and share of each arm, in the order of the study.
        law: The control law, where the question is whether the arm arrives under it.
        unit: Of the threshold in the question; empty if it has none.
        ended: Names of the arms of which a single lock ends the task in every configuration, so that their share is 0 whatever
            the samples: they are level with none that may have more.
    """

    question: str
    about: str
    entries: tuple[tuple[str, Interval], ...]
    law: str = ""
    unit: str = ""
    ended: frozenset[str] = frozenset()

    @property
    def ranked(self) -> tuple[tuple[str, Interval], ...]:
        """The entries, best first."""
        return tuple(sorted(self.entries, key=lambda e: (-e[1].value, e[0] in self.ended)))

    @property
    def level(self) -> list[str]:
        """The first, and the arms whose interval overlaps its own; those that are 0 by structure only if all are."""
        first, p = self.ranked[0]
        some = self.ranked if first in self.ended else [e for e in self.ranked if e[0] not in self.ended]
        return [name for name, other in some if other.high >= p.low]


def standings(
    found: Sequence[Assessed], laws: Sequence[Driven], asked: Mapping[Key, float], ended: Sequence[Assessed] = ()
) -> list[Standing]:
    """One for each index and task, as found and optimised, and for each law.

    Args:
        found: Assessments.
        laws: Maps of convergence.
        asked: Threshold of each index and task.
        ended: Those of ``found`` in which the index is 0, or infinite if smaller is better, whatever the configuration.
    """
    out: list[Standing] = []
    tasks = len({task for _, task in asked}) > 1
    for (index, task), h in asked.items():
        mine = [a for a in found if (a.labels["index"], a.labels["task"]) == (index, task)]
        if not mine:
            continue
        sign = "≥" if mine[0].plan.index.better == "larger" else "≤"
        asks = f"{mine[0].plan.index.name} {sign} {as_given(h)}" + (f", {task}" if tasks else "")
        for optimised in (False, True):
            shares = [(a, a.interval(h, optimised)) for a in mine]
            entries = [(place(a.labels, [x.labels for x in mine]), p) for a, p in shares if p is not None]
            if entries:
                counts = [a.plain.samples for a in mine if a.plain is not None]
                about = f"{counted_range(counts)} poses"
                question = asks + ", best configuration" * optimised
                lost = [a for a in mine if any(a is x for x in ended) and (h > 0 or a.plan.index.better == "smaller")]
                names = frozenset(place(a.labels, [x.labels for x in mine]) for a in lost)
                out.append(Standing(question, about, tuple(entries), unit=said(mine[0].plan.index.unit, ""), ended=names))
    for law, task in dict.fromkeys((d.labels["law"], d.labels["task"]) for d in laws):
        mine_ = [d for d in laws if (d.labels["law"], d.labels["task"]) == (law, task)]
        entries = [(d.labels["arm"], d.any) for d in mine_]
        more = f", {task}" if len({d.labels["task"] for d in laws}) > 1 else ""
        joints = counted_range([len(d.arrives) - 1 for d in mine_])
        about = f"{counted_range([d.motions for d in mine_])} motions × {joints} joints"
        out.append(Standing(f"arrives under {law}{more}", about, tuple(entries), law + more))
    return out


def structures_of(found: Sequence[Assessed]) -> dict[tuple[str, str], Structure]:
    """What locks do to each arm and task whatever the configuration, by fingerprint and name of the task."""
    plans = {(a.plan.arm.fingerprint, a.plan.index.task.name): a.plan for a in found}
    return {key: structure(plan.arm, plan.index.task) for key, plan in plans.items()}


def ended_of(found: Sequence[Assessed], structures: dict[tuple[str, str], Structure]) -> list[Assessed]:
    """Assessments in which some failure leaves a singular Jacobian, and so the worst value, in every configuration."""
    ended = []
    for a in found:
        own = structures[a.plan.arm.fingerprint, a.plan.index.task.name]
        hit = own.never or any(set(f) & set(own.fatal) for f in a.plan.index.failures)
        if hit and a.plan.index.slug in _WORST_IF_SINGULAR:
            ended.append(a)
    return ended


def place(labels: Mapping[str, Any], among: Sequence[Mapping[str, Any]]) -> str:
    """An arm, and where and with which failures if it is there more than once."""
    twice = sum(other["arm"] == labels["arm"] for other in among) > 1
    more = f", {labels.get('region', '')}, {labels.get('failures', 'single')}" if twice else ""
    return f"{labels['arm']}{more}"


def counted_range(counts: Sequence[int]) -> str:
    """``2,000``, or ``1,900 to 2,000``."""
    return " to ".join(f"{c:,}" for c in dict.fromkeys((min(counts), max(counts))))


def said(unit: str, before: str = " ") -> str:
    """A unit behind a number."""
    return "" if unit in ("", "1") else f"{before}{unit}"
