"""The numbers to look at first."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup

from holdfast.failures import failure_sets
from holdfast.present.assessment.explanations import explain_index
from holdfast.present.assessment.facts import Facts
from holdfast.present.assessment.sections import collisions
from holdfast.report.page import Block, Table
from holdfast.words import half_width, interval, number, percent

TITLE = "Key numbers"


def blocks(f: Facts) -> list[Block]:
    """The table of key numbers."""
    a, d, index = f.a, f.d, f.index
    facts: list[tuple[str, str | Markup]] = [
        ("Arm", f"{a.arm.name}, {a.arm.n} joints"),
        ("Task", index.task.describe()),
        ("Index", f"worst-case {index.name}{f.unit and f', unit{f.unit}'}; {'larger' if f.larger else 'smaller'} is better"),
        *([("What the index is", explain_index(index))] if explain_index(index) else []),
        ("Failures", f"{len(index.failures)} considered: {_failure_kinds(f)}"),
        ("Region", f"{a.region.name}: {a.region.describe()}"),
        (f"{f.noun.capitalize()}s drawn", f"{d.samples:,}" + ("" if a.complete else f" of {a.poses:,} planned")),
    ]
    if a.region.kind != "joints":
        facts.append(("Reached", f.share(d.reached)))
        facts.append(("No configuration found", f.share(d.unreached)))
    if d.weighted and d.samples:
        facts.append(("Weights", f.weights))
    facts.append(("Singular", f.share(d.singular) + (f"; count as {'0' if f.larger else 'infinite'}" if d.singular else "")))
    if d.infinite:
        facts.append(("Infinite", f.share(d.infinite) + ", of those with a configuration"))
    through = collisions.summary(f)
    if through:
        facts.append((f"Collides with {f.others}", through))
    if d.samples and f.decided:
        facts.append((f"P({f.condition})", f"{interval(f.answer)}; {_why(f)}"))
        if d.unreached and d.reached:
            t = f.threshold
            only = a.interval(at_least=t, reachable_only=True) if f.larger else a.interval(at_most=t, reachable_only=True)
            facts.append(("The same, reached poses only", interval(only)))
    if d.samples:
        facts.append(
            (
                "Error of the CDF",
                f"at most {half_width(d.band())} everywhere at once, with 95 % confidence (Dvoretzky-Kiefer-Wolfowitz)",
            )
        )
    if index.bound is not None and d.reached:
        parts, goal = [], index.best_known or index.bound
        of = "it" if goal == index.bound else f"the best known {goal:.4f}"
        for name, which, _ in f.samples:
            if not which.reached:
                continue
            median, best = (0.0 if f.nothing else x for x in (float(which.quantile(0.5)), which.highest))
            parts.append(
                f"{name + ', ' if len(f.samples) > 1 else ''}the "
                f"median of the {f.reached} is {percent(median / goal)} of {of} "
                f"(gap {number(goal - median)}), the best one {percent(best / goal)}"
            )
        what = "Upper bound" if index.bound_note else "Largest possible value"
        facts.append((what, "; ".join([f"{index.bound:.4f}, which no configuration of any arm can beat", *parts])))
    blocks: list[Block] = [Table([[k, v] for k, v in facts])]
    if d.reached:
        blocks.append(_quantiles(f))
    return blocks


def _failure_kinds(f: Facts) -> str:
    if f.index.failures == failure_sets(f.a.arm, "single"):
        return "each joint locked alone"
    names = f.index.failure_names
    return ", ".join(names) if len(names) <= 12 else f"{', '.join(names[:12])} and {len(names) - 12} more"


def _why(f: Facts) -> str:
    if f.chosen:
        return "the threshold was given"
    if f.index.bound is not None:
        return f"the threshold is half of the {'upper bound' if f.index.bound_note else 'largest possible value'}"
    return f"the threshold is about the median of the {f.reached}, because this index has no known bound"


def _quantiles(f: Facts) -> Table:
    d = f.d
    steps = (0.05, 0.25, 0.5, 0.75, 0.95)
    finite = " of finite values" if d.infinite else ""
    head = [f"Index over … {f.noun}s", "5 %", "25 %", "median", "75 %", "95 %", f"mean{finite}", "best"]
    best = d.highest if f.larger else d.lowest
    rows = [
        [
            f"the {d.reached:,} reached" if d.unreached else f"all {d.samples:,}",
            *[number(float(x)) for x in d.quantile(steps)],
            number(d.mean),
            number(best),
        ]
    ]
    if d.unreached:
        mean = d.total / d.total_weight() if f.larger else np.inf
        label = f"all {d.samples:,}, not found counts as {'0' if f.larger else 'infinite'}"
        rows.append([label, *[number(float(x)) for x in d.quantile(steps, reachable_only=False)], number(mean), number(best)])
    return Table(rows, head, frozenset(range(1, 8)), wide=True)
