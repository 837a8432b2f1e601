"""Presentation of an assessment: the probability of meeting a threshold, and the reasons why it is not met."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.formatting import (
    format_count,
    format_half_width,
    format_interval,
    format_number,
    format_percent,
    list_alternatives,
)
from holdfast.core.probability.distribution import Distribution
from holdfast.interface.presentation.assessment.answer import ThresholdAnswer
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.method import explain_index, list_method
from holdfast.interface.presentation.assessment.page import build_sections, draw_overview
from holdfast.interface.presentation.assessment.sections.gain import draw_cdf_figure
from holdfast.interface.presentation.assessment.tables import build_tables, rank_optimised_upgrades
from holdfast.interface.presentation.collision.shape import describe_cell, summarize_shape
from holdfast.interface.presentation.commands import build_rerun_blocks
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Notice, Presentation
from holdfast.model.failure_modes import failure_sets
from holdfast.studies.assessment.assessment import ZERO_INDEX, Assessment

Thresholds = Sequence[float] | None
_USUAL_THRESHOLDS = (0.05, 0.1, 0.2, 0.3)  # of an index with a bound
_MAX_NAMED_FAILURES = 12


def present(
    assessment: Assessment,
    threshold: float | None = None,
    thresholds: Thresholds = None,
    rates: Mapping[str | int, float] | None = None,
    report: Path | None = None,
) -> Presentation:
    """Present the probability of meeting a threshold, and the poses that are still reached after a lock.

    Args:
        assessment: Assessment to present.
        threshold: Value of the index that the task needs; the first of ``thresholds`` if None. See :meth:`Assessment.report`.
        thresholds: Values of the table of probabilities; see :meth:`Assessment.to_dict`.
        rates: Relative failure rate of each joint, by name or index from 0.
        report: Unused; the command prints the path of the report with the other written files.
    """
    del report
    answer = AssessmentFacts(assessment, thresholds[0] if threshold is None and thresholds else threshold)
    distribution, index = answer.distribution, answer.index
    notices = []
    if not assessment.complete:
        text = (
            f"{distribution.samples:,} of {assessment.poses:,} {answer.noun}s have been evaluated, and all numbers refer to "
            f"these. Repeat the command to resume."
        )
        notices.append(Notice(text, "bad", "This run is not complete"))
    figures = {"overview": FigureSpec(partial(draw_overview, answer), on_page=False)}
    if distribution.reached > distribution.infinite:
        figures["cdf"] = FigureSpec(partial(draw_cdf_figure, answer), on_page=False)
    return Presentation(
        f"Fault tolerance of {assessment.arm.name}",
        answer.headline,
        lines=[f"{assessment.arm.title}: {index.describe()}.", f"{assessment.region.name}: {assessment.region.describe()}."],
        notices=notices,
        facts=_list_facts(answer, rates) if distribution.samples else (),
        tables=partial(build_tables, answer, _choose_thresholds(assessment, thresholds)) if distribution.samples else (),
        figures=figures,
        sections=partial(build_sections, answer),
        method=list_method(answer),
        arm=assessment.arm,
        again=partial(build_rerun_blocks, assessment),
    )


def _list_facts(answer: ThresholdAnswer, rates: Mapping[str | int, float] | None) -> list[Fact]:
    """List the numbers that answer the question; a number that is only a zero is not placed at the top of the page."""
    assessment, distribution, index, noun = answer.assessment, answer.distribution, answer.index, answer.noun
    facts = []
    fatal = answer.task_structures[0].fatal
    if fatal and distribution.reached:
        names = list_alternatives([assessment.arm.joint_names[joint] for joint in fatal])
        text = names if len(fatal) < 4 else f"{len(fatal)} joints"
        facts.append(Fact("single points of failure", text, phrase="whose lock makes the task singular in every configuration"))
    if answer.has_threshold:
        phrase = f"of the {noun}s have {answer.condition}; {_explain_threshold(answer)}"
        phrase = phrase if answer.probability.value else ""
        facts.append(Fact(f"P({answer.condition})", answer.probability, style="percent", phrase=phrase))
        if distribution.unreached and distribution.reached:
            facts.append(Fact("… of the reached poses", answer.interval(reachable_only=True), style="percent"))
    if distribution.reached and not answer.is_worst_everywhere:
        bound = "" if index.bound is None else f", of at most {index.bound:.3f}"
        label = f"median index of the {answer.reached_noun}"
        facts.append(Fact(label, float(distribution.quantile(0.5)), phrase=label + bound))
        if assessment.optimised is not None and assessment.optimised.reached:
            label = "median index at the best configurations"
            facts.append(Fact(label, float(assessment.optimised.quantile(0.5)), phrase=label))
            label = f"P({answer.condition}) at the best configurations"
            facts.append(Fact(label, answer.interval(optimised=True), style="percent"))
    if answer.costliest_lock is not None:
        name, fraction = answer.costliest_lock
        phrase = f"of the poses are still reached after the most costly lock, that of {name}"
        facts.append(Fact(f"poses still reached after a lock of {name}", fraction, style="percent", phrase=phrase))
    if rates and assessment.survivors is not None:
        label = "poses still reached after a failure, weighted by the failure rates"
        facts.append(Fact(label, assessment.expected_survival(rates), style="percent"))
    counts = assessment.worst_counts
    if counts.sum() > 0:
        phrase = (
            f"is the joint whose lock is most often the worst failure, at {format_percent(float(counts.max() / counts.sum()))} "
            f"of the {answer.reached_noun}"
        )
        facts.append(Fact("most often the worst failure", index.failure_names[int(counts.argmax())], phrase=phrase))
    facts.append(Fact("meaning of the index", explain_index(index)))
    facts.append(Fact("failures considered", f"{len(index.failures)}: {_describe_failures(answer)}"))
    planned = "" if assessment.complete else f" of {assessment.poses:,} planned"
    facts.append(Fact(f"sampled {noun}s", f"{distribution.samples:,}{planned}, seed {assessment.seed}"))
    if assessment.region.kind != "joints":
        facts.append(Fact("reached", answer.format_share(distribution.reached)))
        facts.append(Fact("no configuration found (counts as failed)", answer.format_share(distribution.unreached)))
    if distribution.has_weights:
        facts.append(Fact("weights", answer.weights_text))
    singular_value = "" if not distribution.singular else f"; they count as {'0' if answer.larger_is_better else 'infinite'}"
    facts.append(Fact("singular", answer.format_share(distribution.singular) + singular_value))
    if distribution.infinite:
        facts.append(Fact("infinite", f"{answer.format_share(distribution.infinite)}, among the reached poses"))
    facts.append(Fact(f"collisions with {answer.collision_objects}", summarize_collisions(answer)))
    band = f"at most {format_half_width(distribution.band())} at all values simultaneously, with 95 % confidence"
    facts.append(Fact("error of the CDF", f"{band} (Dvoretzky-Kiefer-Wolfowitz)"))
    if index.bound is not None and distribution.reached:
        facts.append(
            Fact("upper bound" if index.bound_note else "largest possible value", _describe_bound(answer, index.bound))
        )
    return [fact for fact in facts if fact.text]


def _describe_bound(answer: ThresholdAnswer, bound: float) -> str:
    """Describe the bound of the index, and the distance of the poses from it."""
    goal = answer.index.best_known or bound
    reference = "it" if goal == bound else f"the best known {goal:.4f}"
    texts = [f"{bound:.4f}, which no configuration of any arm can exceed"]
    for name, distribution in (("", answer.distribution), (" after optimisation", answer.assessment.optimised)):
        if distribution is not None and distribution.reached:
            median, best = (
                0.0 if answer.is_worst_everywhere else value
                for value in (float(distribution.quantile(0.5)), distribution.highest)
            )
            texts.append(
                f"the median of the {answer.reached_noun}{name} is {format_percent(median / goal)} of {reference} "
                f"(gap {format_number(goal - median)}), the best one {format_percent(best / goal)}"
            )
    return "; ".join([*texts, *[answer.index.bound_note] * bool(answer.index.bound_note)])


def _describe_failures(answer: ThresholdAnswer) -> str:
    if answer.index.failures == failure_sets(answer.assessment.arm, "single"):
        return "each joint locked alone"
    names = answer.index.failure_names
    more = f" and {len(names) - _MAX_NAMED_FAILURES} more" if len(names) > _MAX_NAMED_FAILURES else ""
    return ", ".join(names[:_MAX_NAMED_FAILURES]) + more


def _explain_threshold(answer: ThresholdAnswer) -> str:
    if answer.is_chosen:
        return "the threshold was given"
    if answer.index.bound is not None:
        return f"the threshold is half of the {'upper bound' if answer.index.bound_note else 'largest possible value'}"
    return f"the threshold is about the median of the {answer.reached_noun}, because this index has no known bound"


def summarize_collisions(answer: ThresholdAnswer) -> str:
    """Summarise how often the arm collides with itself or its cell; empty if collisions were not checked."""
    counts, clearance = answer.assessment.collisions, answer.assessment.plan.clearance
    if counts is None or clearance is None or not counts.reached:
        return ""
    prefix = "at most " * (clearance.cell is not None)
    text = f"{prefix}{format_percent(counts.found / counts.reached)} of the configurations found collide"
    touched = sorted((item for item in counts.with_each.items() if item[1]), key=lambda item: -item[1])
    text += f" ({', '.join(f'{name} {format_percent(n / counts.reached)}' for name, n in touched)})" if touched else ""
    if answer.assessment.clear is not None:
        text += f"; at least {format_interval(answer.assessment.reached_clear())} of the poses are reached without collision"
    if answer.assessment.optimised is not None:
        limit = f"have a clearance of at least {counts.margin:g} m" if counts.margin else "are collision-free"
        blocked = format_percent(counts.blocked / counts.reached)
        text += f"; the best configurations {limit}, which excluded a better configuration at {blocked} of the poses"
        excluded = f", and {format_count(counts.hopeless, 'pose')} without such a configuration count as failed"
        text += excluded if counts.hopeless else ""
    cell_suffix = "" if clearance.cell is None else f"; {describe_cell(clearance.cell)}"
    return f"{text} ({clearance.capsules.describe(answer.assessment.arm)}{cell_suffix})"


# ---- JSON ----------------------------------------------------------------------------------------------------------------


def to_dict(
    result: Assessment,
    thresholds: Thresholds = None,
    rates: Mapping[str | int, float] | None = None,
    report: Path | None = None,
) -> dict[str, Any]:
    """Return the assessment as JSON data. See :meth:`Assessment.to_dict`."""
    return {**collect_numbers(result, thresholds, rates), "report": None if report is None else str(report)}


def collect_numbers(
    result: Assessment, thresholds: Thresholds, rates: Mapping[str | int, float] | None = None
) -> dict[str, Any]:
    """Collect all numbers of an assessment as JSON data, without the path of its report."""
    distribution = result.distribution
    reached = distribution.reached > 0
    return {
        **result.arm.entry(),
        "fingerprint": result.arm.fingerprint,
        "index": result.index.label,
        **{
            attribute: getattr(result.index, attribute) for attribute in ("unit", "better", "bound", "bound_note", "best_known")
        },
        "task": result.index.task.name,
        "characteristic_length_m": result.index.task.length,
        "region": result.region.to_dict(),
        **{attribute: getattr(result, attribute) for attribute in ("poses", "seed", "sampling", "restarts", "complete")},
        "evaluated": distribution.samples,
        "reached": distribution.reached,
        "not_found": distribution.unreached,
        "singular": distribution.singular,
        "effective_sample_size": distribution.effective() if distribution.has_weights and distribution.samples else None,
        "mean": distribution.mean if reached else None,
        "quantiles": _collect_quantiles(distribution) if reached else None,
        "band_95": distribution.band() if distribution.samples else None,
        "probability": [_collect_probability(result, threshold) for threshold in _choose_thresholds(result, thresholds)]
        if distribution.samples
        else [],
        "gap": result.gap(),
        "worst_counts": dict(zip(result.index.failure_names, result.worst_counts.tolist(), strict=True)),
        "upgrades": _collect_upgrades(result, thresholds),
        "optimised": _collect_optimised_numbers(result, thresholds),
        "clearance": _collect_collision_numbers(result),
        "after_lock": _collect_survival(result),
        "expected_survival": result.expected_survival(rates) if rates and distribution.samples else None,
        "seconds": result.seconds,
    }


def _collect_quantiles(distribution: Distribution) -> dict[str, float]:
    return dict(zip(["0.05", "0.5", "0.95"], distribution.quantile([0.05, 0.5, 0.95]).tolist(), strict=True))


def _collect_optimised_numbers(result: Assessment, thresholds: Thresholds) -> dict[str, Any] | None:
    distribution, counts = result.optimised, result.optimised_worst_counts
    if distribution is None or counts is None or not distribution.reached:
        return None
    return {
        "mean": distribution.mean,
        "quantiles": _collect_quantiles(distribution),
        "probability": [
            _collect_probability(result, threshold, optimised=True) for threshold in _choose_thresholds(result, thresholds)
        ],
        "gap": result.gap(optimised=True),
        "worst_counts": dict(zip(result.index.failure_names, counts.tolist(), strict=True)),
        "upgrades": _collect_upgrades(result, thresholds, optimised=True),
    }


def _collect_collision_numbers(result: Assessment) -> dict[str, Any] | None:
    """Collect how often the arm collides with itself or its cell; None if collisions were not checked."""
    collisions, clearance = result.collisions, result.plan.clearance
    if collisions is None or clearance is None:
        return None
    is_optimised = result.optimised is not None
    counts = {
        "found": collisions.found,
        "best_without_regard": collisions.blocked if is_optimised else None,
        "none_clear": collisions.hopeless if is_optimised else None,
    }
    fractions = {
        f"{name}_fraction": count / collisions.reached if count is not None and collisions.reached else None
        for name, count in counts.items()
    }
    collision_free = None if result.clear is None or not result.distribution.samples else result.reached_clear()
    cell_entries = {
        "found_with": collisions.with_each or None,
        "best_barred_by": collisions.blocked_by if collisions.blocked_by and is_optimised else None,
        "reached_clear": None
        if collision_free is None
        else {"value": collision_free.value, "low": collision_free.low, "high": collision_free.high},
    }
    return {
        "reached": collisions.reached,
        **counts,
        **fractions,
        **cell_entries,
        **summarize_shape(clearance, collisions.margin),
    }


def _collect_upgrades(result: Assessment, thresholds: Thresholds, optimised: bool = False) -> dict[str, Any] | None:
    """Collect the gains of joints that never fail, at the first threshold; None if the poses were not stored."""
    if not result.has_rows or not result.distribution.samples:
        return None
    threshold = thresholds[0] if thresholds else result.default_threshold()
    upgrades = rank_optimised_upgrades(result, threshold) if optimised else result.upgrades(threshold)
    return {"threshold": threshold, "joints": [asdict(upgrade) for upgrade in upgrades]}


def _collect_survival(result: Assessment) -> dict[str, Any] | None:
    if result.survivors is None or not result.distribution.samples:
        return None
    locks = result.locks
    return {
        name: {"value": fraction.value, "low": fraction.low, "high": fraction.high, "locked_at": locks[name]}
        for name, fraction in result.survival().items()
    }


def _choose_thresholds(result: Assessment, requested: Thresholds) -> Sequence[float]:
    if requested:
        return requested
    samples = [
        distribution
        for distribution in (result.distribution, result.optimised)
        if distribution is not None and distribution.reached
    ]
    highest = max((distribution.highest for distribution in samples), default=np.inf)
    if result.index.bound is not None:
        usual = [threshold for threshold in _USUAL_THRESHOLDS if threshold < result.index.bound]
        attained = [threshold for threshold in usual if threshold <= highest]
        if len(attained) > 1 or highest <= ZERO_INDEX or not samples:
            return attained or usual
    return sorted(
        {float(f"{value:.3g}") for distribution in samples for value in distribution.quantile([0.25, 0.5, 0.75]).tolist()}
    )


def _collect_probability(result: Assessment, threshold: float, optimised: bool = False) -> dict[str, Any]:
    key = "at_least" if result.index.better == "larger" else "at_most"
    probability = result.interval(optimised=optimised, **{key: threshold})  # type: ignore[arg-type]
    return {key: threshold, **asdict(probability)}
