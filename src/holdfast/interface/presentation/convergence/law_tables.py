"""Tables of a comparison of laws, for display and as rows of CSV and JSON."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from holdfast.control.convergence.law_comparison import ANY_JOINT, LawComparison
from holdfast.control.simulation.errors import error_kinds
from holdfast.control.simulation.runs import RunOutcome
from holdfast.core.formatting import format_count, format_percent
from holdfast.interface.presentation.presentation import Column, Header, TableSpec, make_headers

OUTCOME_NAMES = [outcome.name.lower() for outcome in RunOutcome]
_RUN_COLUMNS = ("path_length", "path_ratio", "excursion", "time")


def build_outcome_table(comparison: LawComparison) -> TableSpec:
    """Tabulate the outcomes of the runs of each law, for each locked joint."""
    kinds = error_kinds(comparison.laws[0])
    columns: list[Column] = [
        *("law", "locked"),
        *make_headers(OUTCOME_NAMES[0], "95 % interval", *OUTCOME_NAMES[1:], "within reach", style="percent"),
        *make_headers(*(f"median miss, {kind.unit}" for kind in kinds), aligned=False),
    ]
    rows = [
        [
            row["law"],
            row["failure"],
            row["converged"],
            (row["converged_low"], row["converged_high"]),
            *(row[name] for name in (*OUTCOME_NAMES[1:], "reachable")),
            *(_scale(row[f"{kind.key}_astray"], kind.factor) for kind in kinds),
        ]
        for row in comparison.table
    ]
    title = f"Outcomes of {format_count(len(comparison), 'motion')} for each law and lock; joint limits are not enforced"
    return TableSpec(title, columns, rows)


def build_detail_table(comparison: LawComparison) -> TableSpec:
    """Tabulate quantiles of the errors, for the report."""
    kinds, levels = error_kinds(comparison.laws[0]), ("50", "75", "95")
    errors = [f"{kind.text}, {kind.unit}: {'median' if level == '50' else f'{level} %'}" for kind in kinds for level in levels]
    columns: list[Column] = [
        *("law", "locked"),
        *make_headers("converged, of those within reach", "converged within limits", "pass a limit", style="percent"),
        *make_headers(*errors, "path length, divided by the straight distance", aligned=False),
        Header("sum of the joint ranges, rad and m", aligned=False),
    ]
    factors = {f"{kind.key}_{level}": kind.factor for kind in kinds for level in levels}
    percent_keys = ("converged_reachable", "converged_within_limits", "past_limits")
    keys = ("law", "failure", *percent_keys, *factors, "path_ratio", "excursion")
    rows = [[_scale(row[key], factors.get(key)) for key in keys] for row in comparison.table]
    return TableSpec("Quantiles of the final errors, and medians of path and joint ranges", columns, rows, on_console=False)


def _scale(value: Any, factor: float | None) -> Any:
    """Convert an error to its display unit; None stays None."""
    return value if value is None or factor is None else factor * value


def build_gain_table(comparison: LawComparison, gains: list[dict[str, Any]]) -> TableSpec:
    """Tabulate the paired differences to the first law, with their intervals."""
    kinds = error_kinds(comparison.laws[0])
    columns: list[Column] = ["law", "locked", "converged, percentage points", Header("p", digits=2, aligned=False)]
    columns += [f"mean {kind.text}, {kind.unit}" for kind in kinds]
    rows = [
        [
            row["law"],
            row["failure"],
            _format_difference(row, "gain", 100.0),
            row["gain_p_value"],
            *(_format_difference(row, kind.key, kind.factor) for kind in kinds),
        ]
        for row in gains
    ]
    return TableSpec(f"Differences from {comparison.names[0]} over the same motions, with 95 % intervals", columns, rows)


def _format_difference(row: dict[str, Any], key: str, factor: float) -> str:
    """Format a difference with its sign and its interval."""
    value, low, high = (f"{factor * row[name]:+.1f}" for name in (key, f"{key}_low", f"{key}_high"))
    return f"{value} ({low} to {high})"


def build_contact_table(comparison: LawComparison) -> TableSpec:
    """Tabulate the runs with a contact, the converged runs without one, and the objects touched first."""
    percent_columns = make_headers("touch something", "95 % interval", "converge and touch nothing", style="percent")
    rows = []
    for row in comparison.table:
        contacts = comparison.case(row["law"], row["failure"]).contacts or ()
        first_touched = Counter(contact.object for contact in contacts if contact is not None).most_common(2)
        objects = ", ".join(f"{name} ({format_percent(count / len(comparison))})" for name, count in first_touched)
        interval = (row["touched_low"], row["touched_high"])
        rows.append([row["law"], row["failure"], row["touched"], interval, row["converged_clear"], objects or "nothing"])
    title = "Contacts on the way, and the objects that are touched first"
    return TableSpec(title, ["law", "locked", *percent_columns, "touched first"], rows)


def build_cost_table(comparison: LawComparison, costs: list[dict[str, Any]]) -> TableSpec:
    """Tabulate the cost of each law for the healthy arm."""
    columns = ["law"]
    for text in ("from the line, m", "angle, deg", f"time, {comparison.runs[0].unit}"):
        columns += [f"{text}: median", "95 % quantile"]
    title = (
        "Cost while the arm is healthy, over the motions that converge with every law: distance from the straight line, "
        "largest angle to the command, and time to the target"
    )
    return TableSpec(title, columns, [list(row.values()) for row in costs])


def tabulate_gains(comparison: LawComparison) -> list[dict[str, Any]]:
    """Return the paired differences to the first law, with their intervals, for each other law and each joint."""
    table_rows = []
    for name in comparison.names[1:]:
        for failure in [*comparison.joints, ANY_JOINT]:
            row: dict[str, Any] = {"law": name, "than": comparison.names[0], "failure": failure}
            gain = comparison.gain(name, failure)
            row |= {"gain": gain.value, "gain_low": gain.low, "gain_high": gain.high, "gain_p_value": gain.p_value}
            for kind in error_kinds(comparison.laws[0]):
                change = comparison.change(name, kind.name, failure)
                row |= {kind.key: change.value, f"{kind.key}_low": change.low, f"{kind.key}_high": change.high}
            table_rows.append(row)
    return table_rows


def tabulate_healthy_costs(comparison: LawComparison) -> list[dict[str, Any]]:
    """Return medians and 95 % quantiles of the cost of each law for the healthy arm; m, deg, and s or cycles."""
    table_rows = []
    for name in comparison.names:
        row: dict[str, Any] = {"law": name}
        for measure, suffix, factor in (("deviation", "_m", 1.0), ("angle", "_deg", 180 / np.pi), ("time", "", 1.0)):
            median, upper_quantile = factor * comparison.cost(name, measure, (0.5, 0.95))  # type: ignore[arg-type]
            row |= {f"{measure}_50{suffix}": median, f"{measure}_95{suffix}": upper_quantile}
        table_rows.append(row)
    return table_rows


def tabulate_runs(comparison: LawComparison) -> list[dict[str, Any]]:
    """Return the outcome of the run for each law, failure and motion."""
    table_rows: list[dict[str, Any]] = []
    for case in (comparison.case(name, failure) for name in comparison.names for failure in comparison.failures):
        for motion in range(len(comparison)):
            row: dict[str, Any] = {"law": case.law, "failure": case.failure, "motion": motion}
            row |= {"outcome": OUTCOME_NAMES[case.code[motion]], "reachable": int(case.reachable[motion])}
            row |= {kind.key: f"{getattr(case, kind.name)[motion]:.9g}" for kind in error_kinds(comparison.laws[0])}
            row |= {column: f"{getattr(case, column)[motion]:.9g}" for column in _RUN_COLUMNS}
            row["past_limits"] = int(case.past_limits[motion])
            if case.contacts is not None:
                contact = case.contacts[motion]
                cells = ("", "", "") if contact is None else (f"{contact.time:.9g}", contact.link, contact.object)
                row |= dict(zip(("touched_at", "link", "object"), cells, strict=True))
            table_rows.append(row)
    return table_rows
