"""The page of a comparison of laws, and its tables as CSV."""

from __future__ import annotations

import csv
from functools import partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from holdfast.convergence.law_comparison import HEALTHY, LawComparison
from holdfast.files.output import made, writing
from holdfast.files.spreadsheet import cell
from holdfast.notice import says
from holdfast.present.clearance.shape import shape_text
from holdfast.present.convergence.law_figures import error_figure, gains_figure, healthy_figure, outcome_figure
from holdfast.present.convergence.law_rows import (
    OUTCOME_HEAD,
    error_cell,
    gain_rows,
    headline,
    healthy_rows,
    outcome_cells,
    pairs,
    run_rows,
    signed,
    signed_error,
    time_unit,
    touch_rows,
    within_reach,
)
from holdfast.present.story import how
from holdfast.report import page
from holdfast.report.figures import svg
from holdfast.report.page import Block, Callout, Cell, Page, Picture, Section, Table, Text
from holdfast.simulation.errors import error_kinds
from holdfast.simulation.runs import Outcome
from holdfast.words import capitalised, counted, fixed, number, percent

if TYPE_CHECKING:
    from holdfast.present.results import Drawings


def drawings(c: LawComparison) -> Drawings:
    """``outcomes``; of several laws ``gains`` over the first; of failures ``errors``; and ``healthy``, what a law costs."""
    found: Drawings = {"outcomes": partial(outcome_figure, c)}
    if pairs(c):
        found["gains"] = partial(gains_figure, c)
    if c.joints:
        found["errors"] = partial(error_figure, c)
    if c.comparable.any():
        found["healthy"] = partial(healthy_figure, c)
    return found


@says("drawing the report")
def write(c: LawComparison, path: Path, command: str = "") -> Path:
    """The page."""
    return page.write(build(c, command), path)


def build(c: LawComparison, command: str = "") -> Page:
    """The report as blocks, before it becomes HTML."""
    sections = [
        Section("Which converge", _outcomes(c)),
        Section(f"What the others gain over {c.names[0]}", _gains(c)),
        Section("How far off the target", _errors(c)),
        *([Section("What they touch on the way", _touches(c))] if c.clearance is not None else []),
        Section("What it costs while nothing has failed", _healthy(c)),
    ]
    return Page(
        f"Control laws after a lock that nobody has noticed: {c.arm.name}",
        headline(c),
        sections,
        subtitle=c.about or f"{counted(len(c), 'motion')}, task {c.laws[0].task.describe()}",
        warnings=_alerts(c),
        facts=_facts(c),
        method=_method(c),
        again=command,
    )


def _facts(c: LawComparison) -> list[tuple[Cell, Cell]]:
    """How often each law reaches the target after a lock, the best first."""
    if not c.joints:
        return []
    ranked = sorted(((c.share_any(name), name) for name in c.names), key=lambda x: -x[0].value)
    found: list[tuple[Cell, Cell]] = [
        (percent(p.value), f"of the motions reach the target with {name}; {percent(p.low)} to {percent(p.high)}, 95 %")
        for p, name in ranked[:4]
        if p.value
    ]
    within = within_reach(c)
    return [*found, (percent(within), "of the targets are still within reach")] if within else found


def _alerts(c: LawComparison) -> list[Callout]:
    found = []
    undecided = max(float((r.code == Outcome.UNDECIDED).mean()) for r in c.runs)
    if undecided > 0.05:
        found.append(
            Callout(
                f"Up to {percent(undecided)} of the runs of a law are undecided and count as not converged; read the "
                f"fractions with "
                "that in mind.",
                title="Undecided runs",
            )
        )
    past = max(float(r.limits_passed.any(axis=1).mean()) for r in c.runs)
    if past > 0:
        found.append(
            Callout(
                f"Joint limits are reported, not enforced: up to {percent(past)} of the runs of a law pass one, where a real "
                "arm would stop.",
                title="Joint limits",
            )
        )
    touching = max(float(np.mean([x is not None for x in r.first_contacts])) for r in c.runs)
    if touching > 0:
        found.append(
            Callout(
                f"Contacts are reported, not enforced: up to {percent(touching)} of the runs of a law touch something, where a "
                "real arm would stop.",
                title="Contacts",
            )
        )
    return found


@says("writing the results")
def save(c: LawComparison, folder: Path, command: str = "") -> list[Path]:
    """``outcomes.csv`` (:attr:`LawComparison.table`), ``healthy.csv``, ``runs.csv``, ``gains.csv`` and the page."""
    tables = {"outcomes": c.table, "healthy": healthy_rows(c), "runs": run_rows(c)}
    if pairs(c):
        tables["gains"] = gain_rows(c)
    files = [made(folder) / f"{name}.csv" for name in tables]
    for file, rows in zip(files, tables.values(), strict=True):
        with writing(file) as stream:
            writer = csv.writer(stream)
            writer.writerow(map(cell, rows[0]))
            writer.writerows([cell(row[name]) for name in rows[0]] for row in rows)
    return [*files, c.report(folder / "report.html", command=command)]


# ---- sections ----------------------------------------------------------------------------------------------------


def _outcomes(c: LawComparison) -> list[Block]:
    rows: list[list[Cell]] = []
    for r in c.table:
        of_these = "–" if r["converged_reachable"] is None else percent(r["converged_reachable"])
        rows.append([*outcome_cells(r), of_these, percent(r["converged_within_limits"]), percent(r["past_limits"])])
    head = [*OUTCOME_HEAD, "converged of these", "converged within limits", "past a limit"]
    caption = (
        f"{counted(len(c), 'motion')} each; exact intervals. Within reach: some configuration of the failed arm has the "
        "end effector at the target (found by search, joint limits aside). Past a limit: a joint left its range on the way."
    )
    image = svg(outcome_figure(c), "outcomes", "Stacked bars of how the runs ended, by joint and law")
    return [
        Picture(
            image,
            f"How {counted(len(c), 'motion')} ended under each law, healthy and with each joint locked from the start. Bars "
            "end at 1; converged: at the target; stuck: stopped elsewhere; moving: never stops, as it repeats its motion; "
            "undecided: mostly still moving at the time limit.",
        ),
        Table(rows, head, frozenset(range(2, len(head))), caption=caption, wide=True),
    ]


def _gains(c: LawComparison) -> list[Block]:
    if not pairs(c):
        return []
    kinds = error_kinds(c.laws[0])
    rows: list[list[Cell]] = []
    for r in gain_rows(c):
        rows.append(
            [
                r["law"],
                r["failure"],
                signed(r, "gain", 100.0, 1),
                f"{r['gain_p_value']:.2g}",
                *(signed_error(r, kind) for kind in kinds),
            ]
        )
    head = [
        "law",
        "locked",
        "converge, percentage points",
        "p",
        *(f"mean {kind.text}, {kind.unit}" for kind in kinds),
    ]
    caption = (
        f"Differences to {c.names[0]} over the same motions, with 95 % intervals: paired by Newcombe's method with exact "
        "limits and McNemar's test for a joint; for any joint from the mean over the joints of each motion, by betting, "
        "which always covers. "
        "Of errors by Student's t, which may cover less than 95 % of few motions when a few of them differ much. "
        "Undecided runs count as not converged. Many comparisons at once: one "
        "in twenty looks significant by chance."
    )
    image = svg(gains_figure(c), "gains", "Paired differences to the first law, by joint")
    return [
        Picture(image, f"Paired differences to {c.names[0]}, {counted(len(c), 'motion')}; lines are 95 % intervals."),
        Table(rows, head, frozenset(range(2, 6)), caption=caption, wide=True),
    ]


def _errors(c: LawComparison) -> list[Block]:
    if not c.joints:
        return []
    kinds = error_kinds(c.laws[0])
    rows: list[list[Cell]] = []
    for r in c.table:
        if r["failure"] == HEALTHY:
            continue
        errors = [error_cell(r, kind, of, "–") for kind in kinds for of in ("50", "75", "95", "astray")]
        more = [r["path_ratio"], r["excursion"]]
        rows.append([r["law"], r["failure"], *errors, *["–" if x is None else number(x) for x in more]])
    of_kinds = [[f"{capitalised(kind.text)}, {kind.unit}: median", "75 %", "95 %", "astray"] for kind in kinds]
    head = ["law", "locked", *chain.from_iterable(of_kinds), "path", "joints"]
    caption = (
        "Quantiles over all runs, at their ends. Astray: median of the runs that did not converge. Path: median of the tool's "
        "path length divided by the straight distance. Joints: median of the sum of the ranges they went through, rad (and m)."
    )
    image = svg(error_figure(c), "errors", "Distribution of the end error by law")
    count = len(c) * len(c.joints)
    return [
        Picture(
            image,
            f"{counted(count, 'run')} of each law, every joint alike.",
        ),
        Table(rows, head, frozenset(range(2, len(head))), caption=caption, wide=True),
    ]


def _touches(c: LawComparison) -> list[Block]:
    assert c.clearance is not None
    found = touch_rows(c)
    caption = (
        f"{counted(len(c), 'motion')} each; exact intervals. Looked at from instant to instant, and between them until half a "
        "millimetre is all that could change; of a run that repeats its motion the first 200/Ke. "
        "Distances are lower bounds: at most so many touch, and no contact is missed. "
        "In brackets: of all runs, those that touch it first."
    )
    return [Table([list(row) for row in found.rows], found.head, frozenset(range(2, 5)), caption=caption, wide=True)]


def _healthy(c: LawComparison) -> list[Block]:
    if not c.comparable.any():
        return [Text("No motion converges under every law while the arm is healthy, so there is nothing to compare.")]
    rows: list[list[Cell]] = []
    for r in healthy_rows(c):
        rows.append([r["law"], *["–" if np.isnan(r[k]) else fixed(r[k], 3) for k in list(r)[1:]]])
    head = ["law", "off the line: median, m", "95 %", "angle: median, deg", "95 %", f"time: median, {time_unit(c)}", "95 %"]
    image = svg(healthy_figure(c), "healthy", "Quantiles of what each law costs the healthy arm")
    caption = (
        f"Over the {counted(int(c.comparable.sum()), 'motion')} that converge under every law with no joint locked, each at 65 "
        "samples."
    )
    return [Picture(image, caption), Table(rows, head, frozenset(range(1, 7)))]


def _method(c: LawComparison) -> list[Block]:
    first = c.runs[0]
    facts: list[tuple[Cell, Cell]] = [("Motions", c.about or "as they were given")]
    facts += [(name, law.describe()) for name, law in zip(c.names, c.laws, strict=True)]
    facts += [
        ("Failures", f"each alone, from the start: {', '.join(c.joints) or 'none'}; the controller does not know"),
        (
            "Time",
            f"control cycles, at most {first._setting.limit:g}" if first.cycles else f"at most {first._setting.limit:g} s",
        ),
        ("Converged", f"error at most {c.accuracy:g} {'as a cycle begins' if first.cycles else 'at rest'}"),
        *([] if c.clearance is None else [("Contacts", f"with {shape_text(c.clearance, 0.0)}")]),
        ("Undecided", "; ".join(f"{n}: {_reasons(c, n)}" for n in c.names)),
    ]
    return how(c.arm, *facts)


def _reasons(c: LawComparison, name: str) -> str:
    return ", ".join(f"{count} {reason}" for reason, count in c.reasons(name).items()) or "none"
