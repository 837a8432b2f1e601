"""Presentation of a comparison of laws."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.control.convergence.law_comparison import ANY_JOINT, HEALTHY_CASE, LawComparison
from holdfast.control.simulation.errors import error_kinds
from holdfast.control.simulation.runs import RunOutcome
from holdfast.core.files.csv_table import write_rows
from holdfast.core.formatting import capitalise_first, format_count, format_number, format_percent
from holdfast.core.probability.intervals import Difference
from holdfast.interface import report
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.convergence.law_tables import (
    OUTCOME_NAMES,
    build_contact_table,
    build_cost_table,
    build_detail_table,
    build_gain_table,
    build_outcome_table,
    tabulate_gains,
    tabulate_healthy_costs,
    tabulate_runs,
)
from holdfast.interface.presentation.convergence.shares import rank_successes
from holdfast.interface.presentation.presentation import Fact, FigureSpec, Notice, Presentation

_NOTABLE_UNDECIDED_FRACTION = 0.05
_COST_MEASURES = (
    ("deviation", "distance from the line, m", 1.0),
    ("angle", "largest angle, deg", 180 / np.pi),
    ("time", "time to the target, {unit}", 1.0),
)
_GAIN_METHOD = (
    "Paired over the same motions, with 95 % intervals. One joint: Newcombe's method for paired proportions with exact limits, "
    "and McNemar's test. Any joint: a betting interval of the mean over the joints of each motion, whose coverage is "
    "guaranteed. Errors: Student's t, whose coverage may be below 95 % if there are few motions and a few of them differ much. "
    "Undecided runs count as not converged. Of many comparisons, one in twenty looks significant by chance."
)
_CONTACT_METHOD = (
    "Distances are computed in steps so small that none can change by more than half a millimetre in between, and for a run "
    "that repeats its motion over the first 200/Ke. They are lower bounds, so the fractions are upper bounds and no contact is "
    "missed"
)
_OUTCOME_CAPTION = (
    "Converged: the end effector stops at the target. Stuck: it stops elsewhere. Moving: it never stops, because it repeats "
    "its motion. Undecided: none of these could be shown, mostly because it was still moving at the time limit."
)


def to_dict(comparison: LawComparison) -> dict[str, Any]:
    """Return outcomes, gains over the first law, and the cost of each law for the healthy arm, as JSON data."""
    data: dict[str, Any] = {
        **comparison.arm.entry(),
        "task": comparison.laws[0].task.name,
        "motions": len(comparison),
        "about": comparison.about,
        "laws": {name: law.describe() for name, law in zip(comparison.names, comparison.laws, strict=True)},
        "outcomes": comparison.table,
        "healthy": tabulate_healthy_costs(comparison),
        "undecided": {name: comparison.reasons(name) for name in comparison.names},
    }
    if can_compare(comparison):
        data["gains"] = tabulate_gains(comparison)
    if comparison.clearance is not None:
        data["clearance"] = summarize_shape(comparison.clearance, 0.0)
    return data


def present(comparison: LawComparison) -> Presentation:
    """Present how often the end effector reaches its target with each law, the gains over the first law, and their cost."""
    laws, arm, names = comparison.laws, comparison.arm, comparison.names
    motions, kinds = format_count(len(comparison), "motion"), error_kinds(laws[0])
    facts = []
    if comparison.joints:
        ranking = sorted(names, key=lambda name: -comparison.share_any(name).value)
        within = compute_reachable_fraction(comparison)
        facts = rank_successes({name: comparison.share_any(name) for name in ranking})
        facts.append(Fact("", within, phrase="of the targets are still within reach", style="percent"))
    tables = [build_outcome_table(comparison), build_detail_table(comparison)]
    files = {
        "outcomes.csv": comparison.table,
        "healthy.csv": tabulate_healthy_costs(comparison),
        "runs.csv": tabulate_runs(comparison),
    }
    figures = {
        "outcomes": FigureSpec(
            partial(_draw_law_outcomes, comparison), "Outcomes by locked joint", _OUTCOME_CAPTION, saved=False
        )
    }
    if can_compare(comparison):
        gains = tabulate_gains(comparison)
        files["gains.csv"] = gains
        tables.append(build_gain_table(comparison, gains))
        caption = f"Paired differences from {names[0]} over {motions}. Lines are 95 % intervals."
        figures["gains"] = FigureSpec(
            partial(_draw_law_gains, comparison), f"Differences from {names[0]}", caption, saved=False
        )
    if comparison.joints:
        caption = f"{format_count(len(comparison) * len(comparison.joints), 'run')} of each law; all joints weigh the same."
        figures["errors"] = FigureSpec(partial(_draw_law_errors, comparison), "Errors at the end", caption, saved=False)
    method: list[tuple[str, str]] = [("Motions", comparison.about or "given by the user")]
    method += [(name, law.describe()) for name, law in zip(names, laws, strict=True)]
    first_run = comparison.runs[0]
    limit = f"at most {first_run._settings.time_limit:g}"
    method += [
        ("Failures", f"one joint locked from the start ({', '.join(comparison.joints) or 'none'}), undetected"),
        ("Time", f"control cycles, {limit}" if first_run.cycles else f"{limit} s"),
        ("Converged", f"error at most {comparison.accuracy:g} {'at the start of a cycle' if first_run.cycles else 'at rest'}"),
        ("Within reach", "a search found a configuration of the failed arm at the target; joint limits are ignored"),
        ("Errors", f"{' and '.join(kind.text for kind in kinds)} at the end; median miss: over the runs that do not converge"),
    ]
    if can_compare(comparison):
        method.append(("Differences", _GAIN_METHOD))
    if comparison.clearance is not None:
        tables.append(build_contact_table(comparison))
        method.append(("Contacts", f"with {describe_shape(comparison.clearance, 0.0)}. {_CONTACT_METHOD}"))
    lines = []
    if comparison.comparable.any():
        tables.append(build_cost_table(comparison, files["healthy.csv"]))
        caption = (
            "Distance from the straight line, largest angle to the command, and time until the error is within 1e-3 of the "
            f"target (in arm lengths and rad), over the {format_count(int(comparison.comparable.sum()), 'motion')} that "
            "converge under every law with no joint locked, each at 65 samples."
        )
        title = "Cost while the arm is healthy"
        figures["healthy"] = FigureSpec(partial(_draw_healthy_costs, comparison), title, caption, saved=False)
    else:
        lines.append("No motion converges under every law while the arm is healthy, so there is no cost to compare.")
    reasons = {
        name: ", ".join(f"{count} {reason}" for reason, count in comparison.reasons(name).items()) or "none" for name in names
    }
    method.append(("Undecided", "; ".join(f"{name}: {text}" for name, text in reasons.items())))
    about = comparison.about and f"; {comparison.about}"
    return Presentation(
        f"Control laws after an undetected lock: {arm.name}",
        _compose_answer(comparison),
        about=f"{motions} of {arm.title}, task {laws[0].task.describe()}{about}",
        lines=lines,
        notices=_list_notices(comparison),
        facts=facts,
        tables=tables,
        figures=figures,
        method=method,
        arm=arm,
        exports={name: partial(_write_csv, rows) for name, rows in files.items()},
    )


def _list_notices(comparison: LawComparison) -> list[Notice]:
    """List where a real arm would behave differently, and the undecided runs."""
    fractions = [
        [float((run.code == RunOutcome.UNDECIDED).mean()) for run in comparison.runs],
        [float(run.limits_passed.any(axis=1).mean()) for run in comparison.runs],
        [float(np.mean([contact is not None for contact in run.first_contacts])) for run in comparison.runs],
    ]
    undecided, past_limits, touching = (f"up to {format_percent(max(values))} of the runs of a law" for values in fractions)
    notices = []
    if max(fractions[0]) > _NOTABLE_UNDECIDED_FRACTION:
        notices.append(Notice(f"Undecided runs count as not converged: {undecided} are undecided."))
    if max(fractions[1]) > 0:
        notices.append(Notice(f"Joint limits are reported, not enforced: {past_limits} pass one, where a real arm would stop."))
    if max(fractions[2]) > 0:
        text = f"{touching} touch something, where a real arm would stop."
        notices.append(Notice(f"Contacts are reported, not enforced: {text}"))
    return notices


def _compose_answer(comparison: LawComparison) -> str:
    """Compose the answer in two sentences, and one for each other law."""
    if not comparison.joints:
        rates = [
            f"{format_percent(row['converged'])} converge with {row['law']}"
            for row in comparison.table
            if row["failure"] == HEALTHY_CASE
        ]
        return f"While the arm is healthy, {_join_phrases(rates)}."
    text = "After an undetected lock of one joint, the end effector "
    if any(comparison.share_any(n).value for n in comparison.names):
        shares = [
            f"{format_percent(probability.value) if probability.value else 'none'}{' of the motions' * (index == 0)} with {n}"
            for index, n in enumerate(comparison.names)
            for probability in [comparison.share_any(n)]
        ]
        text += f"reaches its target in {_join_phrases(shares)}"
    else:
        text += f"never reaches its target under any of the {len(comparison.names)} laws"
    within = compute_reachable_fraction(comparison)
    text += f" ({format_percent(within) if within else 'none'} of the targets are still within reach)."
    for name in comparison.names[1:]:
        text += f" {_describe_gain(comparison, name)}"
    return text


def _describe_gain(comparison: LawComparison, name: str) -> str:
    if len(comparison) < 2:
        return ""
    gain = comparison.gain(name)
    first_name = comparison.names[0]
    if gain.low > 0 and comparison.gain(name, undecided="against").low > 0:
        text = f"With {name}, {100 * gain.value:.1f} percentage points more of the motions converge than with {first_name}"
    elif gain.high < 0 and comparison.gain(name, undecided="for").high < 0:
        text = f"With {name}, {-100 * gain.value:.1f} percentage points fewer of the motions converge than with {first_name}"
    else:
        text = f"The runs do not show whether more of the motions converge with {name} or with {first_name}"
    parts = []
    for kind in error_kinds(comparison.laws[0]):
        change = comparison.change(name, kind.name)
        if change.high < 0 or change.low > 0:
            direction = "closer to" if change.value < 0 else "farther from"
            parts.append(f"{format_number(kind.factor * abs(change.value), 3)} {kind.unit} {direction} {kind.whole}")
    return f"{text}{f'; on average, the runs with {name} end ' * bool(parts)}{' and '.join(parts)}."


def _join_phrases(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def compute_reachable_fraction(comparison: LawComparison) -> float:
    """Compute the fraction of targets that are within reach after a lock, as the mean over the joints."""
    return float(np.mean([comparison.case(comparison.names[0], joint).reachable.mean() for joint in comparison.joints]))


def can_compare(comparison: LawComparison) -> bool:
    """Return whether there is anything to compare: two laws, a failure and two motions."""
    return len(comparison.names) > 1 and bool(comparison.joints) and len(comparison) > 1


def _write_csv(rows: Sequence[dict[str, Any]], path: Path) -> None:
    write_rows(path, list(rows[0]), ([row[name] for name in rows[0]] for row in rows))


# ---- figures -------------------------------------------------------------------------------------------------------------


def _draw_law_outcomes(comparison: LawComparison) -> report.Figure:
    """Draw stacked bars of the outcomes, with a group for each failure and a bar for each law."""
    stacks = []
    for failure in comparison.failures:
        cases = [comparison.case(name, failure) for name in comparison.names]
        shares = np.array([[case.has_outcome(outcome).mean() for outcome in OUTCOME_NAMES] for case in cases])
        intervals = [case.share() for case in cases]
        lower, upper = (
            np.array([getattr(interval, bound) if interval else np.nan for interval in intervals]) for bound in ("low", "high")
        )
        stacks.append(
            report.Stack(
                name=failure,
                bars=comparison.names,
                shares=shares,
                low=lower,
                high=upper,
                level=float(cases[0].reachable.mean()),
            )
        )
    return report.stack_figure(
        stacks, OUTCOME_NAMES, f"fraction of the {len(comparison):,} motions", level="targets still within reach"
    )


def _draw_law_gains(comparison: LawComparison) -> report.Figure:
    """Draw the paired differences to the first law, by joint."""
    failures = [*comparison.joints, ANY_JOINT]

    def make_gains(name: str, differences: list[Difference], factor: float = 1.0) -> report.Gains:
        value, lower, upper = (
            factor * np.array([getattr(difference, attribute) for difference in differences])
            for attribute in ("value", "low", "high")
        )
        return report.Gains(label=name, value=value, low=lower, high=upper)

    converged_gains = [
        make_gains(name, [comparison.gain(name, failure) for failure in failures]) for name in comparison.names[1:]
    ]
    error_panels = [
        (
            f"{kind.name.partition('_')[0]} error, {kind.unit}",
            [
                make_gains(name, [comparison.change(name, kind.name, failure) for failure in failures], kind.factor)
                for name in comparison.names[1:]
            ],
        )
        for kind in error_kinds(comparison.laws[0])
    ]
    return report.gain_figure(failures, [("fraction that converges", converged_gains), *error_panels])


def _draw_law_errors(comparison: LawComparison) -> report.Figure:
    """Draw cumulative distributions of the errors at the end, in mm and degrees, over all joints; with one unit also their
    excess.
    """
    kinds = error_kinds(comparison.laws[0])
    quantities: list[tuple[str, str, float]] = [
        (kind.name, f"{capitalise_first(kind.text)} at the end, {kind.unit}", kind.factor) for kind in kinds
    ]
    if len(kinds) == 1:
        quantities.append(("excess", f"Error above the smallest possible, {kinds[0].unit}", kinds[0].factor))
    panels = []
    for quantity, title, factor in quantities:
        samples = [factor * comparison.pool_values(name, quantity).ravel() for name in comparison.names]
        axis_values = np.geomspace(
            1e-5 * factor, 1.2 * max(float(np.nanmax(sample, initial=1e-3 * factor)) for sample in samples), 400
        )
        curves = []
        for name, values in zip(comparison.names, samples, strict=True):
            finite = np.sort(values[np.isfinite(values)])
            curves.append(
                report.Curve(axis_values, np.searchsorted(finite, axis_values, side="right") / max(len(values), 1), name)
            )
        panels.append((title, curves))
    unit_text = " or ".join(kind.unit for kind in kinds)
    return report.compare_cdf_figure(
        panels, [], f"error, {unit_text}", ylabel="fraction of runs with at most this error", log=True
    )


def _draw_healthy_costs(comparison: LawComparison) -> report.Figure:
    """Draw quantiles of the cost of each law for the healthy arm."""
    spreads = []
    for measure, label, factor in _COST_MEASURES:
        quantiles = factor * np.array([comparison.cost(name, measure) for name in comparison.names])  # type: ignore[arg-type]
        spreads.append(report.Spread(label.format(unit=comparison.runs[0].unit), quantiles))
    return report.spread_figure(comparison.names, spreads)
