"""Answer of a study in a few sentences: the arm that meets the threshold most often, or the reason why no arm does."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from holdfast.core.formatting import format_count, format_interval, format_number, indefinite_article
from holdfast.core.sweeps.study import Study
from holdfast.core.typing import T
from holdfast.interface.presentation.presentation import Fact
from holdfast.studies.designs.designs import choose_best_design, describe_farther_design
from holdfast.studies.study_files.ranking import ArmRanking, Key, format_unit
from holdfast.studies.study_files.results import AssessedCell, DesignSweep, read_labels


def compose_answer(rankings: Sequence[ArmRanking], sweeps: Sequence[DesignSweep] = (), has_rankings: bool = True) -> str:
    """Compose the answer: the best arm for the first index, at the configurations found and at the best ones; the law and
    arm with the most successes; and the best design of each sweep.
    """
    return " ".join([*([_compare_arms(rankings)] if has_rankings else []), *map(_describe_best_design, sweeps)])


def _compare_arms(rankings: Sequence[ArmRanking]) -> str:
    parts = []
    index_standings = [standing for standing in rankings if not standing.law]
    if index_standings:
        standing = index_standings[0]
        best = (
            index_standings[1]
            if index_standings[1:] and index_standings[1].question.startswith(f"{standing.question}, ")
            else None
        )
        parts.append(_explain_absence(standing, best) if standing.is_uninformative else _describe_leader(standing, best))
    law_standings = [standing for standing in rankings if standing.law]
    if law_standings:
        top = max(law_standings, key=lambda standing: standing.ranked_entries[0][1].value)
        success_rate = format_interval(top.ranked_entries[0][1])
        parts.append(
            f"After an undetected lock hardly any motion reaches its target under any law: the largest fraction of {top.about} "
            f"is {success_rate}, for {name_leader(top)} under {top.law}."
            if top.is_uninformative
            else f"After an undetected lock, {name_leader(top)} reaches its target most often, under {top.law}: in "
            f"{success_rate} of the motions."
        )
    return " ".join(parts)


def _describe_leader(standing: ArmRanking, best: ArmRanking | None) -> str:
    adverb = " most often" if len(standing.entries) > 1 else ""
    text = f"After any failure considered, {name_leader(standing)}{adverb} keeps {_name_threshold(standing)}: "
    text += f"at {format_interval(standing.ranked_entries[0][1])} of the poses"
    if best is not None:
        text += f"; in the best configuration of each pose, {name_leader(best)}: {format_interval(best.ranked_entries[0][1])}"
    return f"{text}."


def _name_threshold(standing: ArmRanking) -> str:
    return f"{indefinite_article(standing.question)} {standing.question}{format_unit(standing.unit)}"


def _explain_absence(standing: ArmRanking, best: ArmRanking | None) -> str:
    """Explain why hardly any pose meets the threshold, with the best median and the most frequent worst failure."""
    text = f"After any failure considered, hardly any pose keeps {_name_threshold(standing)}: at most "
    text += f"{format_interval(standing.ranked_entries[0][1])} of an arm's poses"
    if best is not None:
        text += f", in the best configuration of each pose {format_interval(best.ranked_entries[0][1])}"
    sentences = [f"{text}."]
    if standing.median:
        name, median = standing.median
        sentences.append(f"{name} has the best median, {median}")
        if best is not None and best.median:
            leader_suffix = "" if best.median[0] == name else f" ({best.median[0]})"
            sentences[-1] += f"; in the best configurations {best.median[1]}{leader_suffix}"
        sentences[-1] += f". Its worst failure is most often a lock of {standing.worst}." if standing.worst else "."
    sentences += [f"{name} is singular in every configuration once {joint} locks." for name, joint in standing.ended.items()]
    return " ".join(sentences)


def name_leader(standing: ArmRanking) -> str:
    """Name the best arm, with the arms whose intervals overlap with its own."""
    leader, *others = standing.tied_with_first
    return f"{leader} (not distinguishable from {', '.join(others)})" if others else leader


def list_leaders(standings: Sequence[ArmRanking]) -> list[Fact]:
    """List the best arm for each of the first questions; the best median where hardly any pose meets the threshold."""
    facts = []
    for standing in standings[:4]:
        (leader, fraction), *_ = standing.ranked_entries
        if not standing.is_uninformative:
            facts.append(Fact("", fraction, phrase=f"{leader}, {standing.question}", style="percent"))
        elif standing.median:
            phrase = f"best median, {standing.median[0]}; hardly any pose has {standing.question}"
            facts.append(Fact("", standing.median[1], phrase=phrase))
    return facts


def _describe_best_design(swept: DesignSweep) -> str:
    """Describe the best design of a sweep in one sentence."""
    best = choose_best_design(swept.guaranteed, swept.reach)
    fraction = format_level(swept)
    text = (
        f"Of {format_count(len(swept.values), 'design')} of {swept.labels['arm']} the best one has a "
        f"{format_index_name(swept)} of at least "
        f"{format_number(float(swept.guaranteed[best]))} at {fraction} of the poses, and a reach of {swept.reach[best]:.3f} m"
    )
    if swept.start is not None:
        text += f" (baseline arm {format_number(float(swept.guaranteed[swept.start]))} and {swept.reach[swept.start]:.3f} m)"
    return f"{text}. {describe_farther_design(swept.guaranteed, swept.reach, best)}".rstrip()


def format_index_name(swept: DesignSweep) -> str:
    """Format the name of the index of a sweep."""
    return str(swept.labels["index"]).replace("-", " ")


def format_level(swept: DesignSweep) -> str:
    """Format the fraction of the poses that have at least the index quantile of a sweep."""
    return f"{100 * swept.plan['level']:.4g} %"


def read_cells(study: Study, job: str, read: Callable[[Study, int], T]) -> list[T]:
    """Read the existing results of all combinations (cells) with one kind of job."""
    matching = [cell for cell in range(len(study.cells)) if read_labels(study, cell)["job"] == job]
    return [read(study, cell) for cell in matching if study.cell_folder(cell).exists()]


def get_index_key(assessed: AssessedCell) -> Key:
    """Return the index and the task of an assessed combination."""
    return assessed.labels["index"], assessed.labels["task"]
