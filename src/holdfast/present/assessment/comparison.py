"""The report of a comparison: one HTML file that begins with the table."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from numpy.typing import NDArray

from holdfast.arm.model import Arm
from holdfast.arms.tool import attachment_text
from holdfast.assessment.assessment import Assessment
from holdfast.assessment.comparison import Comparison
from holdfast.assessment.upgrade import MOST_OPTIMISED_AGAIN
from holdfast.notice import says
from holdfast.present.assessment import thresholds
from holdfast.present.assessment.console import best_upgrades
from holdfast.present.assessment.facts import Facts
from holdfast.present.assessment.sections.upgrades import paired
from holdfast.present.clearance.shape import cell_text
from holdfast.present.commands import capsule_files, command_line, region_files
from holdfast.report import figures as drawing
from holdfast.report import page
from holdfast.report.figures import Curve, Mark
from holdfast.report.page import Block, Callout, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.words import article, as_given, counted, fixed, half_width, interval, number, percent

_MOST_UPGRADES = 3  # joints per candidate; its own report has all


@says("drawing the report")
def write(comparison: Comparison, path: Path) -> Path:
    """The comparison as a page, which begins with the table."""
    return page.write(build(comparison), path)


def build(comparison: Comparison) -> Page:
    """The comparison as blocks, before it becomes HTML."""
    c = comparison
    first = Facts(c.assessments[0], c.threshold)
    unfinished = [n for n, a in zip(c.names, c.assessments, strict=True) if not a.complete]
    alerts = []
    if unfinished:
        names = ", ".join(unfinished)
        alerts.append(Callout("Run the same command again to resume.", "bad", f"Not complete: {names}."))
    sections = [
        Section("", [Callout(" ".join(c.notes), title="Before comparing")] if c.notes else []),
        Section("The candidates", [_table(c, first)]),
        Section("How the index is distributed", _distributions(c, first)),
        Section("Which joint deserves a redundant motor or brake", _upgrades(c, first)),
        Section("About each candidate", [_candidates(c)]),
    ]
    return Page(
        f"Fault tolerance of {len(c.names)} candidates",
        _headline(c, first),
        sections,
        subtitle=first.a.region.name,
        warnings=alerts,
        method=_method(c, first),
        again=_again(c),
    )


def _headline(c: Comparison, f: Facts) -> str:
    wanted = (
        f"{f.index.name} of at {'least' if f.larger else 'most'} {as_given(c.threshold)}{f.unit} after any failure considered"
    )
    tasks = list(dict.fromkeys(a.index.task.name for a in c.assessments))
    if len(tasks) > 1:
        verdicts = [f"{task}, {_leader(c, task)}" for task in tasks]
        return f"Probability of keeping {article(wanted)} {wanted}, the best candidate of each task: {'; '.join(verdicts)}."
    ranked = c.ranking()
    best, second = (c.interval(name) for name in ranked[:2])
    if best.value == 0:
        text = f"No candidate keeps {article(wanted)} {wanted} at any {f.noun} of the region."
        text += _nearest(c)
    else:
        text = f"{ranked[0]} keeps {article(wanted)} {wanted} with the largest probability, {interval(best)}; next is "
        text += f"{ranked[1]} with {interval(second)}."
        if second.value < best.value and not _apart(c):
            text += f" Their intervals overlap: more {f.noun}s would tell them apart."
    if all(a.optimised is not None for a in c.assessments):
        chosen = _ahead(c, optimised=True)
        p = c.interval(chosen[0], optimised=True)
        if p.value > 0:
            text += f" After optimisation the largest probability is that of {' and '.join(chosen)}, {interval(p)}."
    return text


def _ahead(c: Comparison, optimised: bool = False) -> list[str]:
    """The candidates with the largest probability."""
    values = {name: c.interval(name, optimised).value for name in c.names}
    return [name for name, value in values.items() if value == max(values.values())]


def _apart(c: Comparison) -> bool:
    """The intervals of the two best candidates do not overlap."""
    best, second = (c.interval(name) for name in c.ranking()[:2])
    return second.high < best.low


def _nearest(c: Comparison) -> str:
    """Of several that keep nothing the one with the best median: why it is so, and what it has."""
    there = [(r["median"], r["name"], a) for r, a in zip(c.table, c.assessments, strict=True) if r["median"] is not None]
    if not there:
        return ""
    sign = 1.0 if c.assessments[0].index.better == "larger" else -1.0
    _, name, a = max(there, key=lambda entry: sign * entry[0])
    return f" Nearest is {name}. {Facts(a, c.threshold).why}"


def _leader(c: Comparison, task: str) -> str:
    name = c.best(task)
    p = c.interval(name)
    return f"{name} with {interval(p)}" if p.value > 0 else "none"


def _table(c: Comparison, f: Facts) -> Table:
    """One row per candidate."""
    optimised = any(a.optimised is not None for a in c.assessments)
    survival = any(a.survivors is not None for a in c.assessments)
    head: list[Cell] = ["Candidate", "task", "redundancy", "reached", f"P({'≥' if f.larger else '≤'} {as_given(c.threshold)})"]
    head += [*["optimised"] * optimised, "median", *["left after a lock"] * survival, "worst failure"]
    rows = []
    for r, a in zip(c.table, c.assessments, strict=True):
        cells: list[Cell] = [r["name"], r["task"], str(r["redundancy"])]
        cells += [_with_interval(r, "reached"), _with_interval(r, "probability")]
        cells += [_with_interval(r, "optimised_probability")] * optimised
        cells.append(_stacked([_value(r["median"]), *[f"{_value(r['optimised_median'])} opt."] * optimised]))
        cells += [_value(r["expected_survival"])] * survival
        cells.append(_stacked([_worst(r, a, ""), *[f"{_worst(r, a, 'optimised_')} opt."] * optimised]))
        points = [str(a.arm.joint_index(name) + 1) for name in r["single_points_of_failure"]]
        cells.append("every joint" if len(points) == a.arm.n else ", ".join(points) or "none")
        rows.append(cells)
    caption = (
        f"P: fraction of the {counted(f.d.samples, f.noun)} whose {f.condition}, with 95 % intervals; medians are over the "
        "reached ones. Redundancy: joints minus rows of the task. Joints are numbered from the "
        "base. Single point of failure: a joint whose lock ends the task "
        "in every configuration."
    )
    if optimised:
        caption += " Optimised (opt.): at the best configurations."
    if survival:
        caption += " Left after a lock: fraction of the poses still reached, every joint equally likely to fail."
    numbers = frozenset(range(2, 6 + optimised + survival))
    return Table(rows, [*head, "single point of failure"], numbers, caption=caption, wide=True)


def _with_interval(row: dict[str, Any], name: str) -> Cell:
    if row[name] is None:
        return "–"
    low, high = (fixed(row[f"{name}_{end}"], 3) for end in ("low", "high"))
    return _stacked([fixed(row[name], 3), f"{low} to {high}"])


def _stacked(lines: list[str]) -> Cell:
    """The first line, and the others quiet below it."""
    more = [Markup('<br><span class="quiet">{}</span>').format(x) for x in lines[1:]]
    return Markup("").join([Markup("{}").format(lines[0]), *more])


def _value(x: float | None) -> str:
    return "–" if x is None else number(x)


def _worst(row: dict[str, Any], a: Assessment, before: str) -> str:
    """Numbers of the joints that fail, from 1: names are too long for this table."""
    name = row[f"{before}worst_joint"]
    if name is None:
        return "–"
    failed = a.index.failures[a.index.failure_names.index(name)]
    return f"{'+'.join(str(k + 1) for k in failed)} ({percent(row[f'{before}worst_fraction'])})"


def figures(c: Comparison) -> dict[str, Figure]:
    """The cumulative distributions of all candidates; nothing where there is no finite value."""
    f = Facts(c.assessments[0], c.threshold)
    pairs = list(zip(c.names, c.assessments, strict=True))
    samples = [("As inverse kinematics found them" if f.a.region.kind != "joints" else "Cumulative (CDF)", pairs, False)]
    if any(a.optimised is not None for a in c.assessments):
        samples.append(("After optimisation", [(n, a) for n, a in pairs if a.optimised is not None], True))
    axis, log = _axis(c, f)
    if axis is None:
        return {}
    marks = [Mark(c.threshold, f"threshold {as_given(c.threshold)}{f.unit}")]
    if (bound := _bound(c)) is not None:
        marks.append(Mark(bound, f"no configuration can exceed {bound:.3f}", "bound"))
    panels = [(title, [Curve(axis, a.cdf(axis, optimised=o), n) for n, a in some]) for title, some, o in samples]
    return {
        "compare": drawing.compare_cdf_figure(panels, marks, f.axis_label, ylabel="fraction with a smaller value, F", log=log)
    }


def _bound(c: Comparison) -> float | None:
    """What no configuration of any candidate can exceed, where that is one number."""
    bounds = {a.index.bound for a in c.assessments}
    return bounds.pop() if len(bounds) == 1 else None


def _axis(c: Comparison, f: Facts) -> tuple[NDArray[np.float64] | None, bool]:
    """Values of the index over which all distributions are drawn, and whether evenly by ratio; none where none is finite."""
    every = [a.of(o) for a in c.assessments for o in (False, True)[: 1 + (a.optimised is not None)]]
    ends = [x for d in every for x in (d.lowest, d.highest) if np.isfinite(x)]
    if not ends:
        return None, False
    log = not f.larger and min(ends) > 0 and max(ends) > 20 * min(ends)
    ends += [x for x in (c.threshold, _bound(c)) if x is not None]
    if log:
        return np.geomspace(min(ends), max(ends), 801), True
    return np.linspace(min(0.0, *ends), 1.04 * max(0.0, *ends), 801), False


def _asked(c: Comparison, f: Facts, figure: Figure, band: float) -> Block:
    """A threshold to move, with the probability of each candidate and who leads there."""
    axis, log = _axis(c, f)
    assert axis is not None
    asked = thresholds.steps(axis, log, c.threshold)
    there = [replace(c, threshold=x) for x in asked.tolist()]
    answers: dict[str, list[str]] = {}
    if len({a.index.task.name for a in c.assessments}) == 1:
        answers["Largest probability"] = [_leading(x) for x in there]
    for name, a in zip(c.names, c.assessments, strict=True):
        answers[name] = [interval(x.interval(name)) for x in there]
        if a.optimised is not None:
            answers[f"{name}, best configurations"] = [interval(x.interval(name, optimised=True)) for x in there]
    return thresholds.slider(f, asked, answers, figure, "each curve", band)


def _leading(c: Comparison) -> str:
    """The candidate that is ahead, and whether that is sure; those that are where several have the same."""
    ahead = _ahead(c)
    if len(ahead) > 1:
        return "all alike" if len(ahead) == len(c.names) else f"{' and '.join(ahead)} alike"
    return ahead[0] if _apart(c) else f"{ahead[0]}; its interval overlaps with the next"


def _distributions(c: Comparison, f: Facts) -> list[Block]:
    """What the figure shows, and a threshold to move over it."""
    drawn = c.figures()
    if not drawn:
        return []
    meets = "1 − F" if f.larger else "F"
    text = (
        f"Over all {counted(f.d.samples, f.noun)} of each candidate; the probability of meeting a threshold is {meets} there. "
    )
    if any(a.distribution.unreached for a in c.assessments):
        text += f"A pose without a configuration counts as {'0' if f.larger else 'infinite'}. "
    width = max(a.distribution.band() for a in c.assessments)
    text += f"The 95 % band of each curve is {half_width(width)}."
    picture = Picture(drawing.svg(drawn["compare"], "compare", "Cumulative distributions of all candidates"), text)
    return [picture, _asked(c, f, drawn["compare"], width)]


def _upgrades(c: Comparison, f: Facts) -> list[Block]:
    """The joints of each candidate that gain most if they never fail."""
    rows: list[list[Cell]] = []
    missing = [n for n, a in zip(c.names, c.assessments, strict=True) if not a.kept]
    optimised = any(a.optimised is not None for a in c.assessments)
    for name, a in zip(c.names, c.assessments, strict=True):
        ranked = c.upgrades(name) if a.kept else []
        best = {u.joint: u for u in best_upgrades(a, c.threshold)} if a.kept else {}
        for place, u in enumerate(ranked[:_MOST_UPGRADES]):
            row: list[Cell] = ["" if place else name, u.joint, f"{u.before:.3f}", f"{u.after:.3f}", paired(u)]
            if optimised:
                row += [f"{best[u.joint].after:.3f}", paired(best[u.joint])] if best else ["–", "–"]
            rows.append(row)
    blocks: list[Block] = []
    if rows:
        head = ["Candidate", "if this never fails", "P now", "P then", "gain, 95 % interval"]
        head += ["after optimisation", "gain, 95 % interval"] * optimised
        caption = f"P({f.condition}). The {_MOST_UPGRADES} joints of each candidate that gain most; its own report has all."
        blocks.append(Table(rows, head, frozenset(range(2, len(head))), caption=caption, wide=True))
        text = (
            "Suppose that a redundant motor or brake keeps one joint from failing: the worst case is then over the "
            f"failures in which it has no part, at the same {f.noun}s and configurations. The intervals are paired: a gain is "
            f"the fraction of the {f.noun}s that fail now and would not then."
        )
        if optimised:
            text += f" After optimisation: configurations of up to {MOST_OPTIMISED_AGAIN} {f.noun}s optimised again without it."
        blocks.append(Text(text, quiet=True))
    if missing:
        blocks.append(Text(f"The {f.noun}s of {', '.join(missing)} were not kept, so they are not in this table."))
    return blocks


def _candidates(c: Comparison) -> Table:
    rows: list[list[Cell]] = []
    for name, a in zip(c.names, c.assessments, strict=True):
        bound = "not known" if a.index.bound is None else f"{a.index.bound:.3f}"
        gaps = [number(x) for x in (a.gap(), a.gap(True) if a.optimised is not None else None) if x is not None]
        code = Markup("<code>{}</code>").format(a.arm.fingerprint[:10])
        source = a.arm.source if len(a.arm.source) <= 60 else a.arm.source[:59] + "…"
        ends = "" if a.arm.chain is None else f"; {a.arm.chain}"
        rows.append(
            [name, a.arm.name, _tool(a.arm), bound, " → ".join(gaps) or "–", (source or "no source given") + ends, code]
        )
    head = ["Candidate", "arm", "tool", "bound of the index", "gap of the median", "source", "fingerprint"]
    caption = (
        "Tool: x, y, z; roll, pitch, yaw as in URDF, in the last link's own frame. Bound: no configuration can exceed it. "
        "Gap: by how much the median of the reached poses falls short of it"
    )
    caption += ", before → after optimisation." if any(a.optimised is not None for a in c.assessments) else "."
    return Table(rows, head, frozenset({3, 4}), caption=caption, wide=True)


def _tool(arm: Arm) -> str:
    x, y, z, *angles = (as_given(float(v)) for v in attachment_text(arm).split(","))
    return f"{x}, {y}, {z} m; {', '.join(angles)} deg"


def _method(c: Comparison, f: Facts) -> list[Block]:
    a = f.a
    why = "it was given"
    if not c.chosen:
        bounded = all(x.index.bound is not None for x in c.assessments)
        why = (
            "half of the smallest bound"
            if bounded
            else "about the middle of the candidates' medians, because this index has no bound"
        )
    seeds = sorted({x.seed for x in c.assessments})
    facts: list[tuple[str, str]] = [
        ("Region", f"{a.region.name}: {a.region.describe()}"),
        ("Samples", f"{counted(f.d.samples, f.noun)} of each candidate, {a.sampling}, seed {', '.join(map(str, seeds))}"),
        ("Index", f"worst-case {f.index.name}{f.unit and f', unit{f.unit}'}; {'larger' if f.larger else 'smaller'} is better"),
        ("Threshold", f"{as_given(c.threshold)}{f.unit}: {why}"),
        ("Not found", f"a pose without a configuration counts as {'0' if f.larger else 'infinite'}"),
        ("Intervals", "95 %: Clopper-Pearson (exact) for a probability, Dvoretzky-Kiefer-Wolfowitz for a whole CDF"),
        (
            "Ranking",
            "by the probability of meeting the threshold as inverse kinematics found the configurations; then the median",
        ),
    ]
    if len(seeds) == 1 and len({x.sampling for x in c.assessments}) == 1:
        facts.append(("Same poses", "every candidate was tried at the same poses of the region"))
    shapes = [
        (n, x.plan.clearance.capsules.describe(x.arm)) for n, x in zip(c.names, c.assessments, strict=True) if x.plan.clearance
    ]
    around = {x.plan.cell.digest: cell_text(x.plan.cell) for x in c.assessments if x.plan.cell is not None}
    if around:
        facts.append(("Cell", "; ".join(around.values())))
    if shapes and any(x.optimised is not None for x in c.assessments):
        what = "; ".join(f"{name}: {shape}" for name, shape in shapes)
        facts.append(
            (
                "Clearance",
                f"best configurations keep the arm clear of itself{' and the cell' * bool(around)}, by capsules ({what})",
            )
        )
    return [Table([[k, v] for k, v in facts])]


def _again(c: Comparison) -> list[Block]:
    """The command of each candidate, and the files they need."""
    blocks: list[Block] = []
    for name, run in zip(c.names, c.assessments, strict=True):
        command, note = command_line(run)
        blocks.append(
            Text(f"{name}: {note}") if command is None else Code(command, f"{name} alone{f' ({note})' if note else ''}:")
        )
        blocks += capsule_files(run)
    region = c.assessments[0].region
    return [*blocks, *(region_files(region) if region.storable else [])]
