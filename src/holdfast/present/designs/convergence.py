"""The report of a search of designs that still reach their targets after an unidentified lock."""

from __future__ import annotations

import shlex
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure

from holdfast import arms
from holdfast.designs.convergence import FAILURES, TARGETS, ConvergenceDesigns
from holdfast.files.output import put
from holdfast.notice import says
from holdfast.present.designs.figures import parameters_figure
from holdfast.present.designs.page import ARM_FILE, bounds_callout, parameters_table
from holdfast.present.story import how
from holdfast.probability.intervals import Difference, Interval
from holdfast.report import figures as drawing
from holdfast.report import page
from holdfast.report.page import Block, Cell, Code, Page, Picture, Section, Table, Text
from holdfast.words import capitalised, fixed, percent

_MEANINGS = {
    "guaranteed": "fraction of the targets, by area, that the arm reaches whatever lock leaves them within reach",
    "free": "fraction of the locks that leave the target within reach after which nothing holds the arm away from it",
    "converged": "fraction of all locks after which the arm reaches its target; a target out of reach counts as 0",
    "reached": "fraction of the targets within reach of the healthy arm",
}


@says("drawing the report")
def write(d: ConvergenceDesigns, path: Path) -> Path:
    """What to build, what that gains, and how it was found, as a page."""
    return page.write(build(d), path)


@says("writing the results")
def save(d: ConvergenceDesigns, folder: Path) -> list[Path]:
    """designs.csv, a row for each design with its values (m, rad) and measures (fractions), best-arm.yaml and report.html."""
    lines = [",".join((*d.space.names, *d.measures))]
    columns = [*d.values.T.tolist(), *(m.tolist() for m in d.measures.values())]
    lines += [",".join(f"{x:.9g}" for x in row) for row in zip(*columns, strict=True)]
    files = put(folder, {"designs.csv": "\n".join(lines) + "\n", ARM_FILE: d.arm_file()})
    return [*files, d.report(folder / "report.html")]


def figures(d: ConvergenceDesigns) -> dict[str, Figure]:
    """What each design is worth, by one number at a time."""
    factors = np.array([p.shown[0] for p in d.space.parameters])
    names = [f"{p.name}, {p.shown[1]}" for p in d.space.parameters]
    value = d.measures[d.objective if d.exact else "converged"]
    start = d.values[0] * factors, float(value[0])
    return {"parameters": parameters_figure(names, d.values * factors, value, start, f"fraction, {d.objective}")}


def build(d: ConvergenceDesigns) -> Page:
    """The report as blocks, before it becomes HTML."""
    best = d.values[d.best]
    return Page(
        f"Designs of {d.law.arm.name} that reach their targets after an unknown lock",
        headline(d),
        [
            Section("What to build", [*(bounds_callout(d.space, best) if d.best else []), parameters_table(d.space, best)]),
            Section("What that gains", _gains(d)),
            Section("Which parameter matters", [_numbers(d)]),
            Section("The best arm as a file", _file(d)),
        ],
        subtitle=f"{d.law.describe()}; {', '.join(d.space.names)}",
        facts=[x for x in _facts(d) if x[0] != "0 %"],
        method=_method(d),
        again=_again(d),
    )


def _facts(d: ConvergenceDesigns) -> list[tuple[Cell, Cell]]:
    """What the best design and the given arm are worth."""
    if d.checked is not None:
        given, best, _ = d.checked
        said = "of fresh failures, after which it reaches its target:"
        pairs = [(best.value, f"{said} the best design")] * (d.best > 0) + [(given.value, f"{said} the given arm")]
    else:
        measure = d.measures[d.objective if d.exact else "converged"]
        pairs = [(float(measure[d.best]), f"{d.objective}, the best design"), (float(measure[0]), "the given arm")][
            : 1 + (d.best > 0)
        ]
    return [*((percent(value), about) for value, about in pairs), (f"{len(d.values):,}", "designs were tried")]


def headline(d: ConvergenceDesigns) -> str:
    """The answer in one or two sentences."""
    if d.checked is not None:
        given, best, apart = d.checked
        if d.best == 0:
            return f"Nothing better than the given arm was found: it reaches its target in {_share(given)} of fresh failures."
        text = (
            "After a lock that the controller does not know of, the best design reaches its target in "
            f"{_share(best)} of fresh failures, the given arm in {_share(given)}: {_points(apart)} more."
        )
        return text if apart.low > 0 else f"No gain that holds on fresh failures was found. {text} Search with more targets."
    name = d.objective if d.exact else "converged"
    given_, best_ = (percent(float(d.measures[name][k])) for k in (0, d.best))
    if d.best == 0:
        return f"Nothing better than the given arm was found; {name}: {given_}, the {_MEANINGS[name]}."
    return f"The best design has {name} {best_}, the given arm {given_}: the {_MEANINGS[name]}."


def _share(p: Interval) -> str:
    return f"{percent(p.value)} ({percent(p.low)} to {percent(p.high)}, 95 %)"


def _points(x: Difference) -> str:
    value, low, high = (fixed(100 * y, 1) for y in (x.value, x.low, x.high))
    return f"{value} points ({low} to {high})"


def _gains(d: ConvergenceDesigns) -> list[Block]:
    rows: list[list[Cell]] = [
        [name, percent(float(m[0])), percent(float(m[d.best])), _MEANINGS[name]] for name, m in d.measures.items()
    ]
    head = ["Measure", "given arm", "best design", "what it is"]
    blocks: list[Block] = [
        Table(rows, head, frozenset({1, 2}), caption=f"As measured in the search, over {len(d.values):,} designs.")
    ]
    if d.checked is not None:
        given, best, apart = d.checked
        fresh: list[list[Cell]] = [["converged", _share(given), _share(best), _points(apart)]]
        told = "On targets and failures that had no part in the search, the same for both."
        blocks.append(Table(fresh, ["Fresh", "given arm", "best design", "difference"], frozenset({1, 2, 3}), caption=told))
    else:
        blocks.append(Text("Having no sink and no singular trap does not prove convergence: limit cycles exist.", quiet=True))
    return blocks


def _numbers(d: ConvergenceDesigns) -> Picture:
    (figure,) = figures(d).values()
    text = "Each design by one parameter at a time; the others differ too. Designs from the climbs crowd around the best."
    return Picture(drawing.svg(figure, "parameters", "Measure of the designs against each parameter"), text)


def _file(d: ConvergenceDesigns) -> list[Block]:
    label = Markup("<code>{}</code>, which every command takes as ARM:").format(ARM_FILE)
    return [
        Code(d.arm_file().rstrip(), label),
        Text("It has no masses: a table of Denavit-Hartenberg rows holds none.", quiet=True),
    ]


def _method(d: ConvergenceDesigns) -> list[Block]:
    s = d.searched
    measured = (
        "from the stationary sets of the planar arm, all targets at once"
        if d.exact
        else f"simulation: {s['targets']} targets, {s['failures']} failures of each joint at each, the same for all designs; a "
        "joint locks where it is in some configuration at the target, and the arm starts anywhere"
    )
    facts: list[tuple[str, Cell]] = [
        ("Law", d.law.describe()),
        ("Measured", measured),
        (
            "Search",
            f"{s['designs']:,} Sobol designs, those with equal lengths, and pattern searches from {s['climbs']} of them",
        ),
        ("Seed", str(s["seed"])),
    ]
    return how(d.law.arm, *facts, called="given arm")


def _again(d: ConvergenceDesigns) -> list[Block]:
    if not d.exact and (d.searched["targets"], d.searched["failures"]) != (TARGETS, FAILURES):
        return []
    line, remark = command(d)
    return [Code(line, remark and f"{capitalised(remark)}:")]


def command(d: ConvergenceDesigns) -> tuple[str, str]:
    """The command that makes the search again, and a remark."""
    s = d.searched
    spec, words, remark = arms.command_words(d.law.arm)
    words += [f"--maximise convergence --law {shlex.quote(d.law.label)} --task {shlex.quote(d.law.task.name)}"]
    words += [f"--vary {shlex.quote(p.written)}" for p in d.space.parameters] + ["--keep-reach"] * bool(s.get("keep_reach"))
    words.append(f"--designs {s['designs']} --climbs {s['climbs']} --seed {s['seed']}")
    return " \\\n    ".join([f"holdfast design {shlex.quote(spec)}", *words]), remark
