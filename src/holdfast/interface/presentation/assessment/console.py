"""Numbers and console text of an assessment."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.formatting import format_count
from holdfast.interface.presentation.assessment.explanations import explain_index
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.printing import TextTable, format_significant, to_json_types
from holdfast.studies.assessment.answer import ZERO_INDEX, ThresholdAnswer
from holdfast.studies.assessment.upgrade import MAX_REOPTIMISED_POSES

if TYPE_CHECKING:
    from rich.console import Console

    from holdfast.core.probability.distribution import Distribution
    from holdfast.studies.assessment.assessment import Assessment
    from holdfast.studies.assessment.upgrade import Upgrade

Thresholds = Sequence[float] | None
_USUAL_THRESHOLDS = (0.05, 0.1, 0.2, 0.3)  # of an index with a bound


def key_table(result: Assessment) -> TextTable:
    """Return the numbers of poses reached, the distribution of the index over them, and the most frequent worst failure."""
    distribution, counts = result.distribution, result.worst_counts
    table_rows = [["poses reached", f"{distribution.reached:,} of {distribution.samples:,}"]]
    for sampled, label in ((distribution, "as found"), (result.optimised, "at the best configurations")):
        if sampled is not None and sampled.reached:
            lower, median, upper = map(format_significant, sampled.quantile([0.05, 0.5, 0.95]).tolist())
            table_rows.append([f"{result.index.name} {label}: median (5 to 95 %)", f"{median} ({lower} to {upper})"])
    if result.index.bound is not None:
        table_rows.append(["no configuration can exceed", format_significant(result.index.bound)])
    if counts.sum() > 0:
        failure = int(counts.argmax())
        table_rows.append(
            [
                "most often the worst failure",
                f"{result.index.failure_names[failure]} ({100 * counts[failure] / counts.sum():.0f} % of them)",
            ]
        )
    return TextTable(["", ""], table_rows)


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
    data: dict[str, Any] = to_json_types(
        {
            **result.arm.entry(),
            "fingerprint": result.arm.fingerprint,
            "index": result.index.label,
            "unit": result.index.unit,
            "better": result.index.better,
            "bound": result.index.bound,
            "bound_note": result.index.bound_note,
            "best_known": result.index.best_known,
            "task": result.index.task.name,
            "characteristic_length_m": result.index.task.length,
            "region": result.region.to_dict(),
            "poses": result.poses,
            "seed": result.seed,
            "sampling": result.sampling,
            "restarts": result.restarts,
            "complete": result.complete,
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
    )
    return data


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
    """Collect the gains of joints that never fail, at the first threshold; None if the poses were not kept."""
    if not result.has_rows or not result.distribution.samples:
        return None
    threshold = thresholds[0] if thresholds else result.default_threshold()
    upgrades = rank_optimised_upgrades(result, threshold) if optimised else result.upgrades(threshold)
    return {"threshold": threshold, "joints": [asdict(upgrade) for upgrade in upgrades]}


def rank_optimised_upgrades(result: Assessment, threshold: float) -> list[Upgrade]:
    """Return the gains at configurations optimised again without each joint; empty if the run or its index does not
    allow it.
    """
    try:
        return [] if result.optimised is None else result.upgrades(threshold, optimised=True)
    except InputError:  # an index of a class of the user's own cannot be built again for fewer failures
        return []


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
    return {
        key: threshold,
        "value": probability.value,
        "low": probability.low,
        "high": probability.high,
        "confidence": probability.confidence,
    }


def show(
    result: Assessment,
    out: Console,
    thresholds: Thresholds = None,
    rates: Mapping[str | int, float] | None = None,
    report: Path | None = None,
) -> None:
    """Print the question, the distribution of the index, the most frequent worst failure, and the poses reached
    after a lock.
    """
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    del report  # is named with the files that were written
    distribution = result.distribution
    if distribution.samples:
        out.print(f"[bold]{escape(ThresholdAnswer(result, thresholds[0] if thresholds else None).headline)}[/]", soft_wrap=True)
    out.print(f"{escape(result.arm.title)}: {escape(result.index.describe())}", soft_wrap=True)
    explanation = explain_index(result.index)
    if explanation:
        out.print(f"{escape(result.index.name)}: {escape(explanation)}", soft_wrap=True)
    out.print(f"{escape(result.region.name)}: {escape(result.region.describe())}", soft_wrap=True)
    if not result.complete:
        out.print(
            f"[yellow]not finished: {distribution.samples} of {result.poses} poses; the same 'holdfast assess' "
            f"command resumes[/]",
            soft_wrap=True,
        )
    unreached_fraction = distribution.unreached_share if distribution.samples else 0
    unreached_text = f"{unreached_fraction:.1%}{' of the weight' if distribution.has_weights else ''}"
    out.print(
        f"{distribution.samples} poses, seed {result.seed}: {distribution.reached} reached, {distribution.unreached} not "
        f"found within the limits "
        f"({unreached_text}, counted as failed), {distribution.singular} singular",
        soft_wrap=True,
    )
    if not distribution.samples:
        return
    if distribution.has_weights:
        weight_text = (
            f"poses count by weight: effective sample size {distribution.effective():.4g} (total over largest), "
            f"which intervals go by"
        )
        out.print(weight_text, soft_wrap=True)
    samples = [(result.distribution, "as inverse kinematics found them")]
    if result.optimised is not None:
        samples.append((result.optimised, "best configurations found"))
    if distribution.reached:
        reached_samples = [(sampled, name) for sampled, name in samples if sampled.reached]
        for sampled, name in reached_samples:
            lower, median, upper = sampled.quantile([0.05, 0.5, 0.95]).tolist()
            spread = (
                f"median {format_significant(median)}, 5 % {format_significant(lower)}, 95 % "
                f"{format_significant(upper)}, mean {format_significant(sampled.mean)}"
            )
            out.print(f"over reached poses, {name}: {spread}", soft_wrap=True)
        if result.index.bound is not None:
            gap_texts = [
                f"{format_significant(result.index.bound - float(sampled.quantile(0.5)))} ({name})"
                for sampled, name in reached_samples
            ]
            gap_text = f"the median is below that by {', '.join(gap_texts)}"
            remark = f" ({result.index.bound_note})" if result.index.bound_note else ""
            out.print(f"no configuration can beat {format_significant(result.index.bound)}{remark}; {gap_text}", soft_wrap=True)
    _show_collisions(result, out)
    relation = "at least" if result.index.better == "larger" else "at most"
    optimised_header = ["optimised", "95 % interval"] if result.optimised is not None else []
    table = BandedTable(result.index.name, "probability", "95 % interval", *optimised_header)
    for threshold in _choose_thresholds(result, thresholds):
        cells = []
        for optimised in (False, True)[: len(samples)]:
            probability = _collect_probability(result, threshold, optimised)
            cells += [f"{probability['value']:.4f}", f"{probability['low']:.4f} to {probability['high']:.4f}"]
        table.add_row(f"{relation} {threshold:g}", *cells)
    out.print(table)
    columns = [result.worst_counts, *([] if result.optimised_worst_counts is None else [result.optimised_worst_counts])]
    if any(counts.sum() for counts in columns):
        header = "is the worst in" + (" weight" if distribution.has_weights else "")
        table = BandedTable("failure", header, *["optimised"][: len(columns) - 1])
        for failure, name in enumerate(result.index.failure_names):
            if any(counts[failure] for counts in columns):
                table.add_row(
                    escape(name),
                    *[
                        f"{counts[failure]:{'.4g' if distribution.has_weights else 'd'}} "
                        f"({counts[failure] / (counts.sum() or 1):.1%})"
                        for counts in columns
                    ],
                )
        out.print(table)
    _show_upgrades(result, thresholds, out)
    if result.survivors is not None:
        table = BandedTable("once it has locked", "where", "poses still reached", "95 % interval")
        for name, fraction in result.survival().items():
            position = _format_lock_position(result, name)
            table.add_row(escape(name), position, f"{fraction.value:.4f}", f"{fraction.low:.4f} to {fraction.high:.4f}")
        out.print(table)
        if rates:
            survival = result.expected_survival(rates)
            out.print(
                f"after a failure, by how often each joint fails: {survival:.4f} of the poses still reached", soft_wrap=True
            )


def _format_lock_position(result: Assessment, joint: str) -> str:
    """Format the position at which a joint locks, in degrees or metres."""
    position = result.locks[joint]
    if position is None:
        return "as at another pose"
    prismatic = result.arm.prismatic[result.arm.joint_index(joint)]
    return f"{position:.4g} m" if prismatic else f"{math.degrees(position):.4g} deg"


def _show_collisions(result: Assessment, out: Console) -> None:
    """Print how often the arm collides with itself or its cell."""
    from rich.markup import escape

    counts, clearance = result.collisions, result.plan.clearance
    if counts is None or clearance is None or not counts.reached:
        return
    total = counts.reached
    prefix = "at most " * (clearance.cell is not None)
    text = f"the arm collides with {clearance.others} in {prefix}{counts.found / total:.1%} of the {total} configurations found"
    touched = sorted((item for item in counts.with_each.items() if item[1]), key=lambda item: -item[1])
    text += f" ({', '.join(f'{name} {count / total:.1%}' for name, count in touched)})" if touched else ""
    if result.clear is not None:
        text += f"; at least {result.reached_clear().value:.1%} of the poses are reached by a clear one"
    if result.optimised is not None:
        verb_phrase = clearance.too_close(counts.margin)
        text += f"; at the best configuration of {counts.blocked / total:.1%} of the reached poses it {verb_phrase}"
        text += ", so one that is clear was chosen instead" if counts.blocked else ""
        if counts.hopeless:
            text += f", but {counts.hopeless} ({counts.hopeless / total:.1%}) have no clear one and count as failed"
    out.print(escape(f"{text} ({describe_shape(clearance, counts.margin)})"), soft_wrap=True)


def _show_upgrades(result: Assessment, thresholds: Thresholds, out: Console) -> None:
    """Print the joint whose redundant motor or brake would gain most, at the first threshold."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    if not result.has_rows:
        out.print("the poses were not kept, so it is not known which joint deserves a redundant motor or brake", soft_wrap=True)
        return
    threshold = thresholds[0] if thresholds else result.default_threshold()
    ranked = result.upgrades(threshold)
    optimised_by_joint = {upgrade.joint: upgrade for upgrade in rank_optimised_upgrades(result, threshold)}
    useful_upgrades = [
        upgrade
        for upgrade in ranked
        if upgrade.gain > 0 or (upgrade.joint in optimised_by_joint and optimised_by_joint[upgrade.joint].gain > 0)
    ]
    condition = f"{'at least' if result.index.better == 'larger' else 'at most'} {threshold:g}"
    if not useful_upgrades:
        if ranked:
            out.print(f"no single joint that never fails would raise the probability of {condition}", soft_wrap=True)
        return
    optimised_header = ["optimised", "gain", "95 % interval"] if optimised_by_joint else []
    table = BandedTable("if it never failed", f"probability of {condition}", "gain", "95 % interval", *optimised_header)
    for upgrade in useful_upgrades:
        table.add_row(
            escape(upgrade.joint),
            *_format_gain_cells(upgrade),
            *(_format_gain_cells(optimised_by_joint[upgrade.joint]) if optimised_by_joint else []),
        )
    out.print(table)
    if optimised_by_joint:
        count = min(result.distribution.samples, MAX_REOPTIMISED_POSES)
        current = next(iter(optimised_by_joint.values())).before
        out.print(
            f"optimised: configurations of {format_count(count, 'pose')} optimised again without that joint; with it "
            f"{current:.4f}",
            soft_wrap=True,
        )


def _format_gain_cells(upgrade: Upgrade) -> list[str]:
    return [f"{upgrade.after:.4f}", f"{upgrade.gain:+.4f}", f"{upgrade.low:.4f} to {upgrade.high:.4f}"]
