"""HTML report of a comparison of laws, and its tables as CSV."""

from __future__ import annotations

from functools import partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from holdfast.control.convergence.law_comparison import HEALTHY_CASE, LawComparison
from holdfast.control.simulation.errors import error_kinds
from holdfast.control.simulation.runs import RunOutcome
from holdfast.core.files.csv_table import write_rows
from holdfast.core.files.output import make_folder
from holdfast.core.formatting import capitalise_first, format_count, format_decimals, format_number, format_percent
from holdfast.core.progress import reports_progress
from holdfast.interface.presentation.collision.shape import describe_shape
from holdfast.interface.presentation.convergence.law_figures import (
    draw_healthy_costs,
    draw_law_errors,
    draw_law_gains,
    draw_law_outcomes,
)
from holdfast.interface.presentation.convergence.law_rows import (
    OUTCOME_HEADER,
    can_compare,
    compute_reachable_fraction,
    format_difference,
    format_error,
    format_error_change,
    format_outcome_cells,
    get_time_unit,
    headline,
    tabulate_contacts,
    tabulate_gains,
    tabulate_healthy_costs,
    tabulate_runs,
)
from holdfast.interface.presentation.page_content import build_method_blocks
from holdfast.interface.report import page
from holdfast.interface.report.figures import svg
from holdfast.interface.report.page import Block, Callout, Cell, Page, Picture, Section, Table, Text

if TYPE_CHECKING:
    from holdfast.interface.presentation.results import Drawings


def drawings(comparison: LawComparison) -> Drawings:
    """Return functions that draw ``outcomes``, ``gains`` over the first law, ``errors`` after failures, and
    ``healthy`` costs.
    """
    functions: Drawings = {"outcomes": partial(draw_law_outcomes, comparison)}
    if can_compare(comparison):
        functions["gains"] = partial(draw_law_gains, comparison)
    if comparison.joints:
        functions["errors"] = partial(draw_law_errors, comparison)
    if comparison.comparable.any():
        functions["healthy"] = partial(draw_healthy_costs, comparison)
    return functions


@reports_progress("drawing the report")
def write(comparison: LawComparison, path: Path, command: str = "") -> Path:
    """Write the comparison as an HTML report."""
    return page.write(build(comparison, command), path)


def build(comparison: LawComparison, command: str = "") -> Page:
    """Build the report as blocks, before it becomes HTML."""
    sections = [
        Section("Which converge", _build_outcome_blocks(comparison)),
        Section(f"What the others gain over {comparison.names[0]}", _build_gain_blocks(comparison)),
        Section("How far off the target", _build_error_blocks(comparison)),
        *(
            [Section("What they touch on the way", _build_contact_blocks(comparison))]
            if comparison.clearance is not None
            else []
        ),
        Section("What it costs while nothing has failed", _build_healthy_blocks(comparison)),
    ]
    return Page(
        f"Control laws after a lock that nobody has noticed: {comparison.arm.name}",
        headline(comparison),
        sections,
        subtitle=comparison.about or f"{format_count(len(comparison), 'motion')}, task {comparison.laws[0].task.describe()}",
        warnings=_list_alerts(comparison),
        facts=_list_success_rates(comparison),
        method=_build_method_blocks(comparison),
        again=command,
    )


def _list_success_rates(comparison: LawComparison) -> list[tuple[Cell, Cell]]:
    """List how often each law reaches the target after a lock, the best first."""
    if not comparison.joints:
        return []
    ranked = sorted(((comparison.share_any(name), name) for name in comparison.names), key=lambda entry: -entry[0].value)
    entries: list[tuple[Cell, Cell]] = [
        (
            format_percent(probability.value),
            f"of the motions reach the target with {name}; {format_percent(probability.low)} to "
            f"{format_percent(probability.high)}, 95 %",
        )
        for probability, name in ranked[:4]
        if probability.value
    ]
    within = compute_reachable_fraction(comparison)
    return [*entries, (format_percent(within), "of the targets are still within reach")] if within else entries


def _list_alerts(comparison: LawComparison) -> list[Callout]:
    alerts = []
    undecided = max(float((run.code == RunOutcome.UNDECIDED).mean()) for run in comparison.runs)
    if undecided > 0.05:
        alerts.append(
            Callout(
                f"Up to {format_percent(undecided)} of the runs of a law are undecided and count as not converged; read the "
                f"fractions with "
                "that in mind.",
                title="Undecided runs",
            )
        )
    passed = max(float(run.limits_passed.any(axis=1).mean()) for run in comparison.runs)
    if passed > 0:
        alerts.append(
            Callout(
                f"Joint limits are reported, not enforced: up to {format_percent(passed)} of the runs of a law pass one, "
                f"where a real "
                "arm would stop.",
                title="Joint limits",
            )
        )
    touching = max(float(np.mean([contact is not None for contact in run.first_contacts])) for run in comparison.runs)
    if touching > 0:
        alerts.append(
            Callout(
                f"Contacts are reported, not enforced: up to {format_percent(touching)} of the runs of a law touch "
                f"something, where a "
                "real arm would stop.",
                title="Contacts",
            )
        )
    return alerts


@reports_progress("writing the results")
def save(comparison: LawComparison, folder: Path, command: str = "") -> list[Path]:
    """Save ``outcomes.csv`` (:attr:`LawComparison.table`), ``healthy.csv``, ``runs.csv``, ``gains.csv`` and the report."""
    tables = {"outcomes": comparison.table, "healthy": tabulate_healthy_costs(comparison), "runs": tabulate_runs(comparison)}
    if can_compare(comparison):
        tables["gains"] = tabulate_gains(comparison)
    files = [make_folder(folder) / f"{name}.csv" for name in tables]
    for file, rows in zip(files, tables.values(), strict=True):
        write_rows(file, rows[0], ([row[name] for name in rows[0]] for row in rows))
    return [*files, comparison.report(folder / "report.html", command=command)]


# ---- sections ----------------------------------------------------------------------------------------------------


def _build_outcome_blocks(comparison: LawComparison) -> list[Block]:
    table_rows: list[list[Cell]] = []
    for row in comparison.table:
        converged_reachable = "–" if row["converged_reachable"] is None else format_percent(row["converged_reachable"])
        table_rows.append(
            [
                *format_outcome_cells(row),
                converged_reachable,
                format_percent(row["converged_within_limits"]),
                format_percent(row["past_limits"]),
            ]
        )
    header = [*OUTCOME_HEADER, "converged of these", "converged within limits", "past a limit"]
    caption = (
        f"{format_count(len(comparison), 'motion')} each; exact intervals. Within reach: some configuration of the failed "
        f"arm has the "
        "end effector at the target (found by search, joint limits aside). Past a limit: a joint left its range on the way."
    )
    image = svg(draw_law_outcomes(comparison), "outcomes", "Stacked bars of how the runs ended, by joint and law")
    return [
        Picture(
            image,
            f"How {format_count(len(comparison), 'motion')} ended under each law, healthy and with each joint locked from "
            f"the start. Bars "
            "end at 1; converged: at the target; stuck: stopped elsewhere; moving: never stops, as it repeats its motion; "
            "undecided: mostly still moving at the time limit.",
        ),
        Table(table_rows, header, frozenset(range(2, len(header))), caption=caption, wide=True),
    ]


def _build_gain_blocks(comparison: LawComparison) -> list[Block]:
    if not can_compare(comparison):
        return []
    kinds = error_kinds(comparison.laws[0])
    table_rows: list[list[Cell]] = []
    for row in tabulate_gains(comparison):
        table_rows.append(
            [
                row["law"],
                row["failure"],
                format_difference(row, "gain", 100.0, 1),
                f"{row['gain_p_value']:.2g}",
                *(format_error_change(row, kind) for kind in kinds),
            ]
        )
    header = [
        "law",
        "locked",
        "converge, percentage points",
        "p",
        *(f"mean {kind.text}, {kind.unit}" for kind in kinds),
    ]
    caption = (
        f"Differences to {comparison.names[0]} over the same motions, with 95 % intervals: paired by Newcombe's method "
        f"with exact "
        "limits and McNemar's test for a joint; for any joint from the mean over the joints of each motion, by betting, "
        "which always covers. "
        "Of errors by Student's t, which may cover less than 95 % of few motions when a few of them differ much. "
        "Undecided runs count as not converged. Many comparisons at once: one "
        "in twenty looks significant by chance."
    )
    image = svg(draw_law_gains(comparison), "gains", "Paired differences to the first law, by joint")
    return [
        Picture(
            image,
            f"Paired differences to {comparison.names[0]}, {format_count(len(comparison), 'motion')}; lines are 95 "
            f"% intervals.",
        ),
        Table(table_rows, header, frozenset(range(2, 6)), caption=caption, wide=True),
    ]


def _build_error_blocks(comparison: LawComparison) -> list[Block]:
    if not comparison.joints:
        return []
    kinds = error_kinds(comparison.laws[0])
    table_rows: list[list[Cell]] = []
    for row in comparison.table:
        if row["failure"] == HEALTHY_CASE:
            continue
        errors = [format_error(row, kind, statistic, "–") for kind in kinds for statistic in ("50", "75", "95", "astray")]
        motion_values = [row["path_ratio"], row["excursion"]]
        table_rows.append(
            [row["law"], row["failure"], *errors, *["–" if value is None else format_number(value) for value in motion_values]]
        )
    kind_titles = [[f"{capitalise_first(kind.text)}, {kind.unit}: median", "75 %", "95 %", "astray"] for kind in kinds]
    header = ["law", "locked", *chain.from_iterable(kind_titles), "path", "joints"]
    caption = (
        "Quantiles over all runs, at their ends. Astray: median of the runs that did not converge. Path: median of the tool's "
        "path length divided by the straight distance. Joints: median of the sum of the ranges they went through, rad (and m)."
    )
    image = svg(draw_law_errors(comparison), "errors", "Distribution of the end error by law")
    count = len(comparison) * len(comparison.joints)
    return [
        Picture(
            image,
            f"{format_count(count, 'run')} of each law, every joint alike.",
        ),
        Table(table_rows, header, frozenset(range(2, len(header))), caption=caption, wide=True),
    ]


def _build_contact_blocks(comparison: LawComparison) -> list[Block]:
    assert comparison.clearance is not None
    contacts = tabulate_contacts(comparison)
    caption = (
        f"{format_count(len(comparison), 'motion')} each; exact intervals. Looked at from instant to instant, and between "
        f"them until half a "
        "millimetre is all that could change; of a run that repeats its motion the first 200/Ke. "
        "Distances are lower bounds: at most so many touch, and no contact is missed. "
        "In brackets: of all runs, those that touch it first."
    )
    return [Table([list(row) for row in contacts.rows], contacts.head, frozenset(range(2, 5)), caption=caption, wide=True)]


def _build_healthy_blocks(comparison: LawComparison) -> list[Block]:
    if not comparison.comparable.any():
        return [Text("No motion converges under every law while the arm is healthy, so there is nothing to compare.")]
    table_rows: list[list[Cell]] = []
    for row in tabulate_healthy_costs(comparison):
        table_rows.append(
            [row["law"], *["–" if np.isnan(row[column]) else format_decimals(row[column], 3) for column in list(row)[1:]]]
        )
    header = [
        "law",
        "off the line: median, m",
        "95 %",
        "angle: median, deg",
        "95 %",
        f"time: median, {get_time_unit(comparison)}",
        "95 %",
    ]
    image = svg(draw_healthy_costs(comparison), "healthy", "Quantiles of what each law costs the healthy arm")
    caption = (
        f"Over the {format_count(int(comparison.comparable.sum()), 'motion')} that converge under every law with no joint "
        f"locked, each at 65 "
        "samples."
    )
    return [Picture(image, caption), Table(table_rows, header, frozenset(range(1, 7)))]


def _build_method_blocks(comparison: LawComparison) -> list[Block]:
    first_run = comparison.runs[0]
    entries: list[tuple[Cell, Cell]] = [("Motions", comparison.about or "as they were given")]
    entries += [(name, law.describe()) for name, law in zip(comparison.names, comparison.laws, strict=True)]
    entries += [
        ("Failures", f"each alone, from the start: {', '.join(comparison.joints) or 'none'}; the controller does not know"),
        (
            "Time",
            f"control cycles, at most {first_run._settings.time_limit:g}"
            if first_run.cycles
            else f"at most {first_run._settings.time_limit:g} s",
        ),
        ("Converged", f"error at most {comparison.accuracy:g} {'as a cycle begins' if first_run.cycles else 'at rest'}"),
        *([] if comparison.clearance is None else [("Contacts", f"with {describe_shape(comparison.clearance, 0.0)}")]),
        (
            "Undecided",
            "; ".join(f"{law_name}: {_format_undecided_reasons(comparison, law_name)}" for law_name in comparison.names),
        ),
    ]
    return build_method_blocks(comparison.arm, *entries)


def _format_undecided_reasons(comparison: LawComparison, name: str) -> str:
    return ", ".join(f"{count} {reason}" for reason, count in comparison.reasons(name).items()) or "none"
