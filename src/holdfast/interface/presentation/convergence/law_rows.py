"""Numbers and console text of a comparison of laws."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from holdfast.control.convergence.law_comparison import ANY_JOINT, HEALTHY_CASE, LawComparison
from holdfast.control.simulation.errors import ErrorKind, error_kinds
from holdfast.control.simulation.runs import RunOutcome
from holdfast.core.formatting import format_decimals, format_percent
from holdfast.interface.presentation.collision.shape import describe_shape, summarize_shape
from holdfast.interface.presentation.printing import TextTable, format_significant, print_table

if TYPE_CHECKING:
    from rich.console import Console

OUTCOME_NAMES = [o.name.lower() for o in RunOutcome]
_RUN_COLUMNS = ("path_length", "path_ratio", "excursion", "time")
OUTCOME_HEADER = ["law", "locked", "converged", "95 % interval", *OUTCOME_NAMES[1:], "within reach"]


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


def key_table(comparison: LawComparison) -> TextTable:
    """Return how often each law converges with each joint locked."""
    table_rows = [[row["law"], row["failure"], *format_outcome_cells(row)[2:4]] for row in comparison.table]
    return TextTable(["law", "locked", "converged", "95 % interval"], table_rows)


def next_steps(comparison: LawComparison, name: str) -> list[str]:
    """Suggest the gain over the first law and the full report."""
    steps = (
        [f"{name}.gain({comparison.names[1]!r})  # over {comparison.names[0]}, on the same motions"]
        if can_compare(comparison)
        else []
    )
    return [*steps, f'{name}.report("laws.html")']


def show(comparison: LawComparison, out: Console) -> None:
    """Print the headline and the tables."""
    from rich.markup import escape

    kinds = error_kinds(comparison.laws[0])
    out.print(
        f"Arm {escape(comparison.arm.title)}, task {escape(comparison.laws[0].task.describe())}; {escape(comparison.about)}",
        soft_wrap=True,
    )
    out.print(f"[bold]{escape(headline(comparison))}[/]", soft_wrap=True)
    table_rows = [
        [*format_outcome_cells(row), *(format_error(row, kind, "astray", "") for kind in kinds)] for row in comparison.table
    ]
    print_table(out, TextTable([*OUTCOME_HEADER, *(f"astray, {kind.unit}" for kind in kinds)], table_rows))
    kind_names = " and ".join(kind.text for kind in kinds)
    out.print(f"astray: median {kind_names} of the runs that do not converge; joint limits are not enforced", soft_wrap=True)
    if can_compare(comparison):
        table_rows = [
            [
                row["law"],
                row["failure"],
                f"{format_difference(row, 'gain', 100.0, 1)} points",
                *(format_error_change(row, kind) for kind in kinds),
            ]
            for row in tabulate_gains(comparison)
        ]
        titles = [f"{kind.text}, {kind.unit}" for kind in kinds]
        print_table(out, TextTable(["law", "locked", f"converge, more than with {comparison.names[0]}", *titles], table_rows))
    if comparison.clearance is not None:
        print_table(out, tabulate_contacts(comparison))
        out.print(f"contacts are reported, not enforced; {describe_shape(comparison.clearance, 0.0)}", soft_wrap=True)
    if comparison.comparable.any():
        columns = (("deviation", "_m", "m", 3), ("angle", "_deg", "deg", 1), ("time", "", get_time_unit(comparison), 2))
        table_rows = [
            [
                row["law"],
                *(
                    f"{format_decimals(row[f'{measure}_50{suffix}'], digits)} {unit}"
                    for measure, suffix, unit, digits in columns
                ),
            ]
            for row in tabulate_healthy_costs(comparison)
        ]
        header = ["while healthy", "off the straight line", "largest angle to the command", "to the target"]
        print_table(out, TextTable(header, table_rows))
        out.print("medians over the motions that converge with every law", soft_wrap=True)


def format_outcome_cells(row: dict[str, Any]) -> list[str]:
    """Format a row of the outcome table as the cells below ``OUTCOME_HEADER``."""
    interval = f"{format_percent(row['converged_low'])} to {format_percent(row['converged_high'])}"
    return [
        row["law"],
        row["failure"],
        format_percent(row["converged"]),
        interval,
        *(format_percent(row[column]) for column in (*OUTCOME_NAMES[1:], "reachable")),
    ]


def tabulate_contacts(comparison: LawComparison) -> TextTable:
    """Count, for each law and failure, the runs with a contact, the converged runs without one, and the objects
    touched first.
    """
    table_rows = []
    for row in comparison.table:
        first_touched = Counter(
            contact.object for contact in comparison.case(row["law"], row["failure"]).contacts or () if contact is not None
        ).most_common(2)
        objects = ", ".join(f"{name} ({format_percent(count / len(comparison))})" for name, count in first_touched)
        interval = f"{format_percent(row['touched_low'])} to {format_percent(row['touched_high'])}"
        table_rows.append(
            [
                row["law"],
                row["failure"],
                format_percent(row["touched"]),
                interval,
                format_percent(row["converged_clear"]),
                objects or "nothing",
            ]
        )
    return TextTable(
        ["law", "locked", "touch something", "95 % interval", "converge and touch nothing", "touched first"], table_rows
    )


def format_difference(row: dict[str, Any], key: str, factor: float, digits: int) -> str:
    """Format a difference with its sign and its interval."""
    value, lower, upper = (f"{factor * row[name]:+.{digits}f}" for name in (key, f"{key}_low", f"{key}_high"))
    return f"{value} ({lower} to {upper})"


def format_error_change(row: dict[str, Any], kind: ErrorKind) -> str:
    """Format the change of one error with its interval, in the unit for people."""
    return format_difference(row, kind.key, kind.factor, 1)


def format_error(row: dict[str, Any], kind: ErrorKind, statistic: str, placeholder: str) -> str:
    """Format one error of a table row in the unit for people; the statistic is a quantile such as 50, or ``astray``."""
    value = row[f"{kind.key}_{statistic}"]
    return placeholder if value is None else format_significant(kind.factor * value)


def get_time_unit(comparison: LawComparison) -> str:
    """Return the unit of the time of a run."""
    return "cycles" if comparison.runs[0].cycles else "s"


def headline(comparison: LawComparison) -> str:
    """Compose the answer in two sentences."""
    if not comparison.joints:
        rates = {name: format_percent(_get_converged_rate(comparison, name, HEALTHY_CASE)) for name in comparison.names}
        return f"Healthy, {_join_phrases([f'{rate} converge with {name}' for name, rate in rates.items()])}."
    text = "With one joint locked and nobody aware of it, the end effector "
    if any(comparison.share_any(n).value for n in comparison.names):
        shares = [
            f"{format_percent(probability.value) if probability.value else 'none'} with {n}"
            for n in comparison.names
            for probability in [comparison.share_any(n)]
        ]
        text += f"reaches its target in {_join_phrases(shares)} of the motions"
    else:
        text += f"never reaches its target, whichever of the {len(comparison.names)} laws commands it"
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
        text = f"With {name} more converge than with {first_name}, by {_format_percentage_points(gain.value)}"
    elif gain.high < 0 and comparison.gain(name, undecided="for").high < 0:
        text = f"With {name} fewer converge than with {first_name}, by {_format_percentage_points(-gain.value)}"
    else:
        text = f"It cannot be told whether more or fewer converge with {name} than with {first_name}"
    parts = []
    for kind in error_kinds(comparison.laws[0]):
        change = comparison.change(name, kind.name)
        if change.high < 0 or change.low > 0:
            direction = "nearer to" if change.value < 0 else "farther from"
            parts.append(f"{format_significant(kind.factor * abs(change.value), 3)} {kind.unit} {direction} {kind.whole}")
    return f"{text}{'; on average its runs end ' * bool(parts)}{' and '.join(parts)}."


def _format_percentage_points(share: float) -> str:
    return f"{100 * share:.1f} percentage points"


def _join_phrases(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else f"{', '.join(parts[:-1])} and {parts[-1]}"


def _get_converged_rate(comparison: LawComparison, law: str, failure: str) -> float:
    fraction = comparison.case(law, failure).share()
    return fraction.value if fraction else 0.0


def compute_reachable_fraction(comparison: LawComparison) -> float:
    """Compute the fraction of targets that are within reach once a joint has locked, every joint alike."""
    return float(np.mean([comparison.case(comparison.names[0], joint).reachable.mean() for joint in comparison.joints]))


def can_compare(comparison: LawComparison) -> bool:
    """Return whether there is anything to compare: two laws, a failure and two motions."""
    return len(comparison.names) > 1 and bool(comparison.joints) and len(comparison) > 1


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
        for measure, unit, factor in (("deviation", "m", 1.0), ("angle", "deg", 180 / np.pi), ("time", "", 1.0)):
            median, upper_quantile = factor * comparison.cost(name, measure, (0.5, 0.95))  # type: ignore[arg-type]
            row |= {
                "_".join(word for word in (measure, quantile, unit) if word): value
                for quantile, value in (("50", median), ("95", upper_quantile))
            }
        table_rows.append(row)
    return table_rows


def tabulate_runs(comparison: LawComparison) -> list[dict[str, Any]]:
    """Return the end of the run for each law, failure and motion."""
    table_rows: list[dict[str, Any]] = []
    for case in (comparison.case(name, failure) for name in comparison.names for failure in comparison.failures):
        for motion in range(len(comparison)):
            row: dict[str, Any] = {
                "law": case.law,
                "failure": case.failure,
                "motion": motion,
                "outcome": OUTCOME_NAMES[case.code[motion]],
            }
            row["reachable"] = int(case.reachable[motion])
            row |= {kind.key: f"{getattr(case, kind.name)[motion]:.9g}" for kind in error_kinds(comparison.laws[0])}
            row |= {column: f"{getattr(case, column)[motion]:.9g}" for column in _RUN_COLUMNS}
            row["past_limits"] = int(case.past_limits[motion])
            if case.contacts is not None:
                contact = case.contacts[motion]
                row |= {"touched_at": "", "link": "", "object": ""}
                row |= (
                    {}
                    if contact is None
                    else {"touched_at": f"{contact.time:.9g}", "link": contact.link, "object": contact.object}
                )
            table_rows.append(row)
    return table_rows
