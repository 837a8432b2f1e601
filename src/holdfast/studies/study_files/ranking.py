"""Ranking of the arms for each question of a study, with the arms that are not significantly behind the first one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from holdfast.core.formatting import format_as_given, format_number
from holdfast.core.probability.intervals import Interval
from holdfast.studies.assessment.assessment import MIN_INFORMATIVE_PROBABILITY
from holdfast.studies.study_files.results import AssessedCell, DrivenCell

Key = tuple[str, str]  # index and task
Ended = tuple[str, str, str]  # arm, task and failures
_NOT_ZERO = ("mean-singular-value",)  # indices that are not 0 at a singular configuration


@dataclass(frozen=True)
class ArmRanking:
    """Ranking of the arms for one question.

    Attributes:
        question: Short text of the question.
        about: Text on the counted samples and their number.
        entries: Name and fraction of each arm, in the order of the study.
        law: Control law, if the question is whether the arm reaches the target under it.
        unit: Unit of the threshold in the question; empty if it has none.
        ended: Joints whose lock ends the task in every configuration, for each arm whose fraction is 0 by structure.
        median: Arm with the best median, and this median, for use if the fractions are not informative. Empty if unknown.
        worst: Failure that is most often the worst for that arm; empty if unknown.
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
    def ranked_entries(self) -> tuple[tuple[str, Interval], ...]:
        """Entries from the best to the worst."""
        return tuple(sorted(self.entries, key=lambda entry: (-entry[1].value, entry[0] in self.ended)))

    @property
    def tied_with_first(self) -> list[str]:
        """Names of the first arm and of the arms whose interval overlaps with its own, without arms that are 0 by structure."""
        first_name, first_interval = self.ranked_entries[0]
        return [
            name
            for name, interval in self.ranked_entries
            if name == first_name or (interval.high >= first_interval.low and name not in self.ended)
        ]

    @property
    def is_uninformative(self) -> bool:
        """True if no arm has a probability worth reporting."""
        return self.ranked_entries[0][1].value < MIN_INFORMATIVE_PROBABILITY


def rank_arms(
    assessments: Sequence[AssessedCell],
    laws: Sequence[DrivenCell],
    thresholds: Mapping[Key, float],
    fatal_locks: Mapping[Ended, str] | None = None,
) -> list[ArmRanking]:
    """Return one ranking for each index and task, as found and optimised, and for each law.

    Args:
        assessments: Cells with an index over a region.
        laws: Cells with motions under a law.
        thresholds: Thresholds by index and task.
        fatal_locks: Joints, as text, whose lock ends a task in every configuration, by arm, task and failures.
    """
    rankings: list[ArmRanking] = []
    tasks = len({task for _, task in thresholds}) > 1
    for (index, task), threshold in thresholds.items():
        own = [cell for cell in assessments if (cell.labels["index"], cell.labels["task"]) == (index, task)]
        if not own:
            continue
        sign = "≥" if own[0].plan.index.better == "larger" else "≤"
        condition = f"{own[0].plan.index.name} {sign} {format_as_given(threshold)}" + (f", {task}" if tasks else "")
        for optimised in (False, True):
            intervals = [(cell, cell.interval(threshold, optimised)) for cell in own]
            candidates = [
                (label_arm(cell.labels, [other.labels for other in own]), cell, interval)
                for cell, interval in intervals
                if interval is not None
            ]
            entries = [(name, interval) for name, _, interval in candidates]
            # A mean of singular values is not 0 if one of them is, and such a value also meets a threshold of 0.
            structure_matters = index not in _NOT_ZERO and (threshold > 0 or sign == "≤")
            fatal_by_arm = {
                name: fatal_text
                for name, cell, _ in candidates
                if structure_matters and (fatal_text := (fatal_locks or {}).get(make_structure_key(cell))) is not None
            }
            if entries:
                counts = [cell.plain.samples for cell in own if cell.plain is not None]
                about = f"{format_count_range(counts)} poses"
                question = condition + ", best configuration" * optimised
                unit = format_unit(own[0].plan.index.unit, "")
                best_entry = _find_best_median(candidates, fatal_by_arm, optimised)
                median = (
                    ()
                    if best_entry is None
                    else (best_entry[0], f"{format_number(best_entry[1])}{format_unit(own[0].plan.index.unit)}")
                )
                worst = "" if best_entry is None or best_entry[2].worst is None else best_entry[2].worst[0]
                rankings.append(
                    ArmRanking(question, about, tuple(entries), unit=unit, ended=fatal_by_arm, median=median, worst=worst)
                )
    for law, task in dict.fromkeys((driven.labels["law"], driven.labels["task"]) for driven in laws):
        law_cells = [driven for driven in laws if (driven.labels["law"], driven.labels["task"]) == (law, task)]
        entries = [(driven.labels["arm"], driven.mean_fraction) for driven in law_cells]
        task_suffix = f", {task}" if len({driven.labels["task"] for driven in laws}) > 1 else ""
        joints = format_count_range([len(driven.reaches) - 1 for driven in law_cells])
        about = f"{format_count_range([driven.motions for driven in law_cells])} motions × {joints} joints"
        rankings.append(ArmRanking(f"converges under {law}{task_suffix}", about, tuple(entries), law + task_suffix))
    return rankings


def make_structure_key(cell: AssessedCell) -> Ended:
    """Return arm, task, and failures of a cell."""
    return cell.labels["arm"], cell.labels["task"], cell.labels.get("failures", "single")


def _find_best_median(
    candidates: Sequence[tuple[str, AssessedCell, Interval]], fatal_by_arm: Mapping[str, str], optimised: bool
) -> tuple[str, float, AssessedCell] | None:
    """Return the arm with the best median over the reached poses, among arms that are not 0 by structure."""
    medians = []
    for name, cell, _ in candidates:
        distribution = cell.optimised if optimised else cell.plain
        if distribution is not None and distribution.reached and name not in fatal_by_arm:
            medians.append((name, float(distribution.quantile(0.5)), cell))
    choose = max if candidates[0][1].plan.index.better == "larger" else min
    return choose(medians, key=lambda entry: entry[1]) if medians else None


def label_arm(labels: Mapping[str, Any], among: Sequence[Mapping[str, Any]]) -> str:
    """Return the name of an arm, with region and failures if the arm occurs more than once."""
    is_repeated = sum(other["arm"] == labels["arm"] for other in among) > 1
    suffix = f", {labels.get('region', '')}, {labels.get('failures', 'single')}" if is_repeated else ""
    return f"{labels['arm']}{suffix}"


def format_count_range(counts: Sequence[int]) -> str:
    """Format a range of counts: ``2,000``, or ``1,900 to 2,000``."""
    return " to ".join(f"{count:,}" for count in dict.fromkeys((min(counts), max(counts))))


def format_unit(unit: str, prefix: str = " ") -> str:
    """Format a unit after a number."""
    return "" if unit in ("", "1") else f"{prefix}{unit}"
