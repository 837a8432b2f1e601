"""Key numbers of an assessment."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from holdfast.core.formatting import format_half_width, format_interval, format_number, format_percent
from holdfast.interface.presentation.assessment.explanations import explain_index
from holdfast.interface.presentation.assessment.facts import AssessmentFacts
from holdfast.interface.presentation.assessment.sections import collisions
from holdfast.interface.report.page import Block, Table
from holdfast.model.failure_modes import failure_sets


def blocks(facts: AssessmentFacts) -> list[Block]:
    """Build the table of key numbers."""
    assessment, distribution, index = facts.assessment, facts.distribution, facts.index
    entries: list[tuple[str, str | Markup]] = [
        ("Arm", f"{assessment.arm.name}, {assessment.arm.n} joints"),
        ("Task", index.task.describe()),
        (
            "Index",
            f"worst-case {index.name}{facts.unit_suffix and f', unit{facts.unit_suffix}'}; "
            f"{'larger' if facts.larger_is_better else 'smaller'} is better",
        ),
        *([("What the index is", explain_index(index))] if explain_index(index) else []),
        ("Failures", f"{len(index.failures)} considered: {_describe_failures(facts)}"),
        ("Region", f"{assessment.region.name}: {assessment.region.describe()}"),
        (
            f"{facts.noun.capitalize()}s drawn",
            f"{distribution.samples:,}" + ("" if assessment.complete else f" of {assessment.poses:,} planned"),
        ),
    ]
    if assessment.region.kind != "joints":
        entries.append(("Reached", facts.format_share(distribution.reached)))
        entries.append(("No configuration found", facts.format_share(distribution.unreached)))
    if distribution.has_weights and distribution.samples:
        entries.append(("Weights", facts.weights_text))
    entries.append(
        (
            "Singular",
            facts.format_share(distribution.singular)
            + (f"; count as {'0' if facts.larger_is_better else 'infinite'}" if distribution.singular else ""),
        )
    )
    if distribution.infinite:
        entries.append(("Infinite", facts.format_share(distribution.infinite) + ", of those with a configuration"))
    collision_summary = collisions.summarize_collisions(facts)
    if collision_summary:
        entries.append((f"Collides with {facts.collision_objects}", collision_summary))
    if distribution.samples and facts.has_threshold:
        entries.append((f"P({facts.condition})", f"{format_interval(facts.probability)}; {_explain_threshold(facts)}"))
        if distribution.unreached and distribution.reached:
            threshold = facts.threshold
            reached_only = (
                assessment.interval(at_least=threshold, reachable_only=True)
                if facts.larger_is_better
                else assessment.interval(at_most=threshold, reachable_only=True)
            )
            entries.append(("The same, reached poses only", format_interval(reached_only)))
    if distribution.samples:
        entries.append(
            (
                "Error of the CDF",
                f"at most {format_half_width(distribution.band())} everywhere at once, with 95 % confidence "
                f"(Dvoretzky-Kiefer-Wolfowitz)",
            )
        )
    if index.bound is not None and distribution.reached:
        gap_texts, goal = [], index.best_known or index.bound
        reference = "it" if goal == index.bound else f"the best known {goal:.4f}"
        for name, sampled, _ in facts.samples:
            if not sampled.reached:
                continue
            median, best_value = (
                0.0 if facts.is_worst_everywhere else value for value in (float(sampled.quantile(0.5)), sampled.highest)
            )
            gap_texts.append(
                f"{name + ', ' if len(facts.samples) > 1 else ''}the "
                f"median of the {facts.reached_noun} is {format_percent(median / goal)} of {reference} "
                f"(gap {format_number(goal - median)}), the best one {format_percent(best_value / goal)}"
            )
        label = "Upper bound" if index.bound_note else "Largest possible value"
        entries.append((label, "; ".join([f"{index.bound:.4f}, which no configuration of any arm can beat", *gap_texts])))
    blocks: list[Block] = [Table([[entry_label, entry_text] for entry_label, entry_text in entries])]
    if distribution.reached:
        blocks.append(_tabulate_quantiles(facts))
    return blocks


def _describe_failures(facts: AssessmentFacts) -> str:
    if facts.index.failures == failure_sets(facts.assessment.arm, "single"):
        return "each joint locked alone"
    names = facts.index.failure_names
    return ", ".join(names) if len(names) <= 12 else f"{', '.join(names[:12])} and {len(names) - 12} more"


def _explain_threshold(facts: AssessmentFacts) -> str:
    if facts.is_chosen:
        return "the threshold was given"
    if facts.index.bound is not None:
        return f"the threshold is half of the {'upper bound' if facts.index.bound_note else 'largest possible value'}"
    return f"the threshold is about the median of the {facts.reached_noun}, because this index has no known bound"


def _tabulate_quantiles(facts: AssessmentFacts) -> Table:
    distribution = facts.distribution
    levels = (0.05, 0.25, 0.5, 0.75, 0.95)
    finite = " of finite values" if distribution.infinite else ""
    header = [f"Index over … {facts.noun}s", "5 %", "25 %", "median", "75 %", "95 %", f"mean{finite}", "best"]
    best_value = distribution.highest if facts.larger_is_better else distribution.lowest
    table_rows = [
        [
            f"the {distribution.reached:,} reached" if distribution.unreached else f"all {distribution.samples:,}",
            *[format_number(float(value)) for value in distribution.quantile(levels)],
            format_number(distribution.mean),
            format_number(best_value),
        ]
    ]
    if distribution.unreached:
        mean = distribution.total / distribution.total_weight() if facts.larger_is_better else np.inf
        label = f"all {distribution.samples:,}, not found counts as {'0' if facts.larger_is_better else 'infinite'}"
        table_rows.append(
            [
                label,
                *[format_number(float(value)) for value in distribution.quantile(levels, reachable_only=False)],
                format_number(mean),
                format_number(best_value),
            ]
        )
    return Table(table_rows, header, frozenset(range(1, 8)), wide=True)
