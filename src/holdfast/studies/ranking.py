"""Which arm for what: for each question of a study the ranking of the arms, and whether the first is really ahead."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from holdfast.assessment.answer import EMPTY
from holdfast.probability.intervals import Interval
from holdfast.studies.results import Assessed, Driven
from holdfast.words import as_given, number

Key = tuple[str, str]  # index and task
Ended = tuple[str, str, str]  # arm, task and failures
_NOT_ZERO = ("mean-singular-value",)  # at a singular configuration


@dataclass(frozen=True)
class Standing:
    """The ranking of the arms for one question.

    Attributes:
        question: For people, short.
        about: What is counted, of how many.
        entries: Name and share of each arm, in the order of the study.
        law: The control law, where the question is whether the arm reaches the target under it.
        unit: Of the threshold in the question; empty if it has none.
        ended: Of each arm whose share is 0 by structure, the joints whose lock ends the task in every configuration.
        median: Who has the best median, and what it is: what there is to say where the shares say nothing. Empty if unknown.
        worst: The failure that is most often the worst of that arm; empty if unknown.
    """

    question: str
    about: str
    entries: tuple[tuple[str, Interval], ...]
    law: str = ""
    unit: str = ""
    ended: Mapping[str, str] = field(default_factory=dict)
    median: tuple[str, ...] = ()
    worst: str = ""

    @property
    def ranked(self) -> tuple[tuple[str, Interval], ...]:
        """The entries, best first."""
        return tuple(sorted(self.entries, key=lambda e: (-e[1].value, e[0] in self.ended)))

    @property
    def level(self) -> list[str]:
        """The first, and the arms whose interval overlaps its own; an arm that is 0 by structure is level with none."""
        first, top = self.ranked[0]
        return [name for name, p in self.ranked if name == first or (p.high >= top.low and name not in self.ended)]

    @property
    def empty(self) -> bool:
        """No arm has a share worth mentioning."""
        return self.ranked[0][1].value < EMPTY


def standings(
    found: Sequence[Assessed], laws: Sequence[Driven], asked: Mapping[Key, float], ended: Mapping[Ended, str] | None = None
) -> list[Standing]:
    """One for each index and task, as found and optimised, and for each law.

    Args:
        found: Indices over regions.
        laws: Motions under laws.
        asked: Thresholds.
        ended: Joints, as text, whose lock ends a task in every configuration, where there are any.
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
            named = [(place(a.labels, [x.labels for x in mine]), a, p) for a, p in shares if p is not None]
            entries = [(name, p) for name, _, p in named]
            # A mean of singular values is not 0 where one of them is, and a threshold of 0 is met there too.
            hit = index not in _NOT_ZERO and (h > 0 or sign == "≤")
            over = {name: why for name, a, _ in named if hit and (why := (ended or {}).get(row_of(a))) is not None}
            if entries:
                counts = [a.plain.samples for a in mine if a.plain is not None]
                about = f"{counted_range(counts)} poses"
                question = asks + ", best configuration" * optimised
                unit = said(mine[0].plan.index.unit, "")
                first = _best_median(named, over, optimised)
                median = () if first is None else (first[0], f"{number(first[1])}{said(mine[0].plan.index.unit)}")
                worst = "" if first is None or first[2].worst is None else first[2].worst[0]
                out.append(Standing(question, about, tuple(entries), unit=unit, ended=over, median=median, worst=worst))
    for law, task in dict.fromkeys((d.labels["law"], d.labels["task"]) for d in laws):
        mine_ = [d for d in laws if (d.labels["law"], d.labels["task"]) == (law, task)]
        entries = [(d.labels["arm"], d.any) for d in mine_]
        more = f", {task}" if len({d.labels["task"] for d in laws}) > 1 else ""
        joints = counted_range([len(d.reaches) - 1 for d in mine_])
        about = f"{counted_range([d.motions for d in mine_])} motions × {joints} joints"
        out.append(Standing(f"converges under {law}{more}", about, tuple(entries), law + more))
    return out


def row_of(a: Assessed) -> Ended:
    """Arm, task and failures."""
    return a.labels["arm"], a.labels["task"], a.labels.get("failures", "single")


def _best_median(
    named: Sequence[tuple[str, Assessed, Interval]], over: Mapping[str, str], optimised: bool
) -> tuple[str, float, Assessed] | None:
    """Of the arms that are not 0 by structure the one with the best median over the reached poses."""
    medians = []
    for name, a, _ in named:
        d = a.optimised if optimised else a.plain
        if d is not None and d.reached and name not in over:
            medians.append((name, float(d.quantile(0.5)), a))
    choose = max if named[0][1].plan.index.better == "larger" else min
    return choose(medians, key=lambda entry: entry[1]) if medians else None


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
