"""Tables of an assessment, for the console and the page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from holdfast.core.errors import InputError
from holdfast.core.formatting import format_as_given, format_decimals
from holdfast.interface.presentation.assessment.answer import ThresholdAnswer
from holdfast.interface.presentation.presentation import Column, Header, TableSpec
from holdfast.studies.assessment.assessment import Assessment
from holdfast.studies.assessment.comparison import Comparison
from holdfast.studies.assessment.upgrade import Upgrade

_MAX_ROWS = 40
_QUANTILE_LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)


def build_tables(answer: ThresholdAnswer, thresholds: Sequence[float]) -> list[TableSpec]:
    """Build the tables of an assessment; on the page, the sections about failures contain their tables."""
    tables = [tabulate_quantiles(answer), _tabulate_thresholds(answer, thresholds), tabulate_failures(answer)]
    return [table for table in (*tables, tabulate_upgrades(answer), tabulate_survival(answer)) if table is not None]


def tabulate_quantiles(answer: ThresholdAnswer) -> TableSpec | None:
    """Tabulate quantiles of the index over the poses, at the configurations found and at the best ones."""
    distribution, optimised = answer.distribution, answer.assessment.optimised
    if not distribution.reached:
        return None
    noun = f"{answer.noun}s"
    label = f"the {distribution.reached:,} reached {noun}" if distribution.unreached else f"all {distribution.samples:,} {noun}"
    samples = [(label, distribution, True, distribution.mean)]
    if distribution.unreached:
        mean = distribution.total / distribution.total_weight() if answer.larger_is_better else np.inf
        label = f"all {distribution.samples:,} {noun} (not reached: {'0' if answer.larger_is_better else 'infinite'})"
        samples.append((label, distribution, False, mean))
    if optimised is not None and optimised.reached:
        label = f"the {optimised.reached:,} reached {noun}, at their best configurations"
        samples.append((label, optimised, True, optimised.mean))
    rows = [
        [
            label,
            *map(float, sampled.quantile(_QUANTILE_LEVELS, reachable_only=reachable_only)),
            float(mean),
            float(sampled.highest if answer.larger_is_better else sampled.lowest),
        ]
        for label, sampled, reachable_only, mean in samples
    ]
    finite = " of finite values" if distribution.infinite else ""
    columns = [f"{answer.index.name} over"]
    columns += ["median" if level == 0.5 else f"{100 * level:g} %" for level in _QUANTILE_LEVELS]
    return TableSpec("", [*columns, f"mean{finite}", "best"], rows)


def _tabulate_thresholds(answer: ThresholdAnswer, thresholds: Sequence[float]) -> TableSpec:
    """Tabulate the probabilities of meeting thresholds."""
    samples = [(False, "probability"), (True, "optimised")][: 1 + (answer.assessment.optimised is not None)]
    columns = [answer.index.name, *[f"{label}, 95 % interval" for _, label in samples]]
    relation = "at least" if answer.larger_is_better else "at most"
    rows = [
        [f"{relation} {value:g}", *[answer.interval(optimised, threshold=value) for optimised, _ in samples]]
        for value in thresholds
    ]
    return TableSpec("", columns, rows)


def tabulate_failures(answer: ThresholdAnswer) -> TableSpec | None:
    """Tabulate how often each failure is the worst one, and the index after each failure if the poses were stored."""
    assessment = answer.assessment
    if not answer.distribution.reached:
        return None
    labels, counts = answer.failure_labels, assessment.worst_counts
    chosen = np.arange(len(labels))
    if len(chosen) > _MAX_ROWS:
        chosen = np.sort(np.argsort(-counts, kind="stable")[:_MAX_ROWS])
    tail_level = 0.05 if answer.larger_is_better else 0.95
    columns: list[Column] = ["locked"]
    values_by_column = [[labels[failure] for failure in chosen]]
    samples = zip(("", "best: "), answer.samples, (counts, assessment.optimised_worst_counts), strict=False)
    for prefix, (_, _, poses), worst_counts in samples:
        assert worst_counts is not None
        if poses is not None and poses.reached.any():
            values = poses.by_failure[poses.reached]
            weights = None if poses.weight is None else poses.weight[poses.reached]
            quantiles = np.quantile(values, [0.5, tail_level], axis=0, method="inverted_cdf", weights=weights)
            columns += [f"{prefix}median", f"{prefix}{100 * tail_level:.0f} % quantile"]
            values_by_column += [*quantiles[:, chosen].tolist()]
            if answer.has_threshold:
                met = values >= answer.threshold if answer.larger_is_better else values <= answer.threshold
                fractions = np.average(met, axis=0, weights=weights)
                relation = "≥" if answer.larger_is_better else "≤"
                label = f"{prefix}P({relation} {format_as_given(answer.threshold)})"
                columns.append(Header(label, style="percent"))
                values_by_column.append(fractions[chosen].tolist())
        if worst_counts.sum():
            columns.append(Header(f"{prefix}is the worst", style="percent"))
            values_by_column.append((worst_counts[chosen] / worst_counts.sum()).tolist())
    title = f"{answer.index.name} after each failure, over {answer.distribution.reached:,} {answer.reached_noun}"
    title += ", at the configurations found; best: at the best configurations" if len(answer.samples) > 1 else ""
    rows = list(zip(*values_by_column, strict=True))
    return TableSpec(title, columns, rows, on_page=False) if len(columns) > 1 else None


def rank_optimised_upgrades(assessment: Assessment, threshold: float) -> list[Upgrade]:
    """Return the gains at configurations that are optimised again without each joint; empty if the run was not optimised,
    or its index cannot be rebuilt for fewer failures.
    """
    try:
        return [] if assessment.optimised is None else assessment.upgrades(threshold, optimised=True)
    except InputError:  # an index of a user-defined class cannot be rebuilt for fewer failures
        return []


def tabulate_upgrades(answer: ThresholdAnswer) -> TableSpec | None:
    """Tabulate the gain from protecting each joint by a redundant motor or brake."""
    if not (answer.distribution.reached and answer.has_threshold and answer.assessment.has_rows):
        return None
    ranked = answer.assessment.upgrades(answer.threshold)
    optimised = {upgrade.joint: upgrade for upgrade in rank_optimised_upgrades(answer.assessment, answer.threshold)}
    if not ranked:
        return None
    condition = f"P({answer.condition})"
    columns = ["protected joint", *_make_gain_columns(condition)]
    columns += _make_gain_columns("after optimisation") if optimised else []
    title = f"Gain if one joint never failed; without protection {condition} is {ranked[0].before:.3f}"
    title += f", and {next(iter(optimised.values())).before:.3f} after optimisation" if optimised else ""
    rows: list[list[Any]] = []
    for upgrade in ranked[:_MAX_ROWS]:
        cells = [f"{answer.assessment.arm.joint_index(upgrade.joint) + 1}  {upgrade.joint}", *list_gain_cells(upgrade)]
        rows.append(cells + (list_gain_cells(optimised[upgrade.joint]) if optimised else []))
    return TableSpec(title, columns, rows, on_page=False)


def _make_gain_columns(label: str) -> list[Column]:
    return [Header(label, digits=3), "gain, 95 % interval"]


def list_gain_cells(upgrade: Upgrade) -> list[Any]:
    """Return the cells of one upgrade: the probability if the joint never failed, and the gain with its interval."""
    interval = f"{upgrade.gain:+.3f} ({upgrade.low:.3f} to {upgrade.high:.3f})"
    return [upgrade.after, interval if upgrade.gain else f"0 (up to {upgrade.high:.3f})"]


def tabulate_survival(answer: ThresholdAnswer) -> TableSpec | None:
    """Tabulate the fraction of the poses that are still reached after each lock."""
    if answer.assessment.survivors is None:
        return None
    locks = answer.assessment.locks
    rows = [[name, describe_lock(answer, name, locks[name]), share] for name, share in answer.assessment.survival().items()]
    columns = ["locked joint", "position of the lock"]
    return TableSpec("", [*columns, "fraction of the poses still reached"], rows, on_page=False)


def describe_lock(answer: ThresholdAnswer, joint: str, position: float | None) -> str:
    """Describe the position (rad or m) at which a joint is locked, in degrees, or in metres for a prismatic joint."""
    if position is None:
        return "at its position for another pose"
    if answer.assessment.arm.prismatic[answer.assessment.arm.joint_index(joint)]:
        return f"at {format_as_given(position)} m"
    return f"at {format_decimals(math.degrees(position), 1)} deg ({format_as_given(position)} rad)"


def find_leaders(comparison: Comparison, optimised: bool = False) -> list[str]:
    """List the candidates with the largest probability of meeting the threshold."""
    probabilities = {name: comparison.interval(name, optimised).value for name in comparison.names}
    return [name for name, value in probabilities.items() if value == max(probabilities.values())]


def best_intervals_are_disjoint(comparison: Comparison) -> bool:
    """Return whether the intervals of the two best candidates do not overlap."""
    best_interval, runner_up = (comparison.interval(name) for name in comparison.ranking()[:2])
    return runner_up.high < best_interval.low
