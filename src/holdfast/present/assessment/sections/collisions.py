"""How often the arm collides with itself or its cell, and what it was taken to be."""

from __future__ import annotations

from collections import Counter

import numpy as np

from holdfast.assessment.rows import Collisions
from holdfast.clearance.clearance import Clearance
from holdfast.present.assessment.facts import Facts
from holdfast.present.clearance.shape import cell_text
from holdfast.report import figures
from holdfast.report.page import Block, Callout, Picture, Table, Text
from holdfast.words import counted, interval, percent, share

TITLE = "Does the arm collide with {others}?"
_MOST_NAMED = 6  # pairs that are not checked, by name


def blocks(f: Facts) -> list[Block]:
    """How often the arm collides; that nobody looked, if the run chose configurations without looking."""
    found, clearance = f.a.collisions, f.a.plan.clearance
    if found is None or clearance is None:
        if f.a.optimised is None:
            return []
        return [Text("Not checked: nothing kept the best configurations from a collision of the arm with itself.")]
    if not found.reached:
        return []
    arm, capsules = f.a.arm, clearance.capsules
    blocks: list[Block] = []
    if capsules.assumed(arm):
        text = (
            f"The shape of the arm is an assumption: along each link a capsule of radius {capsules.parts[0].radius:.3g} m, "
            "1/20 of the sum of the link lengths. Give the real one by --capsules, or its radius by --radius."
        )
        blocks.append(Callout(text))
    most, cell = "at most " * (clearance.cell is not None), clearance.cell
    hit = f"{most}{share(found.found, found.reached)}"
    facts = [(f"Configurations found that bring the arm into collision with {f.others}", hit)]
    if f.a.clear is not None:
        facts.append((f"Poses reached clear of {f.everything}", f"at least {interval(f.a.reached_clear())} of all"))
    if f.a.optimised is not None:
        close = clearance.too_close(found.margin)
        facts += [
            (f"Poses at whose best configuration the arm {close}", share(found.blocked, found.reached)),
            ("… and one that is clear was chosen instead", share(found.blocked - found.hopeless, found.reached)),
            (
                "… and no clear one was found; they count as not reached after optimisation",
                share(found.hopeless, found.reached),
            ),
            ("Smallest clearance asked of the best configurations", f"{found.margin:g} m"),
        ]
    closest = _closest(f, clearance)
    if closest:
        facts.append((f"Closest where the arm collides with {f.others}", closest))
    facts += [
        ("Capsules", capsules.describe(arm)),
        *(
            []
            if cell is None
            else [("Cell", f"{cell_text(cell)}; margin {cell.margin:g} m, or an object's own if that is larger")]
        ),
        ("Checked", counted(len(clearance.pairs), "pair") + " of capsules"),
        ("Not checked", _ignored(clearance)),
    ]
    blocks.append(Table([[k, v] for k, v in facts], caption=f"Of the {found.reached:,} {f.reached}, not weighted."))
    blocks += _with_each(f, found)
    text = (
        "Links are named by the joint that moves them. The clearance is the smallest distance between capsules that could meet."
    )
    if cell is not None:
        text += " Distances from objects are lower bounds, those of spheres that cover the arm: what is said to be clear is."
    return [*blocks, Text(text, quiet=True)]


def _with_each(f: Facts, found: Collisions) -> list[Block]:
    """Which object is in the way most often, if there is a cell."""
    names = [name for name, count in found.with_each.items() if count or found.blocked_by[name]]
    if not names:
        return []
    names.sort(key=lambda name: -found.with_each[name])
    what = f"{f.noun}s at whose configuration the arm touches it, at most"
    figure = figures.bar_figure(names, [found.with_each[name] for name in names], what, total=found.reached)
    words = "What the arm touches at the configurations found; a configuration that touches several counts for each."
    blocks: list[Block] = [Picture(figures.svg(figure, "in-the-way", "What the arm touches"), words)]
    if found.blocked:
        barred = sorted(names, key=lambda name: -found.blocked_by[name])
        rows = [[name, share(found.blocked_by[name], found.reached)] for name in barred if found.blocked_by[name]]
        blocks.append(Table(rows, ["Nearest at the best configuration, where that is not clear", f"{f.noun}s"], frozenset({1})))
    return blocks


def _closest(f: Facts, clearance: Clearance) -> str:
    """The pair that is closest most often where the arm collides, or nothing."""
    if f.rows is None:
        return ""
    q = f.rows.q[f.rows.reached]
    q = q[clearance(q) < 0]
    if not len(q):
        return ""
    counts = np.bincount(clearance.closest_pair(q), minlength=len(clearance.pair_names))
    k = int(counts.argmax())
    return f"{clearance.pair_names[k]}, in {percent(counts[k] / len(q))} of {counted(len(q), f.noun)}"


def _ignored(clearance: Clearance) -> str:
    """Pairs that are not checked, and why."""
    if not clearance.ignored:
        return "none"
    short = {"adjacent links": "adjacent links", "to be ignored": "as the capsules say"}
    groups = Counter(short.get(p.reason, "") for p in clearance.ignored)
    parts = [f"{n} of {reason}" if reason == "adjacent links" else f"{n} {reason}" for reason, n in groups.items() if reason]
    if groups[""]:
        names = [p.name for p in clearance.ignored if p.reason not in short]
        more = f" and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
        parts.append(f"{len(names)} that overlap nearly always, so by construction: {', '.join(names[:_MOST_NAMED])}{more}")
    return f"{counted(len(clearance.ignored), 'pair')} on different links: {'; '.join(parts)}"


def summary(f: Facts) -> str:
    """One line for the key numbers, or nothing."""
    found, clearance = f.a.collisions, f.a.plan.clearance
    if found is None or clearance is None or not found.reached:
        return ""
    most = "at most " * (clearance.cell is not None)
    text = f"{most}{percent(found.found / found.reached)} of the configurations found"
    if f.a.clear is not None:
        text += f"; at least {interval(f.a.reached_clear())} of the poses are reached by a clear one"
    if f.a.optimised is not None:
        kept = f"keep a clearance of {found.margin:g} m" if found.margin else f"keep the arm clear of {f.everything}"
        text += f"; the best configurations {kept}, which {percent(found.blocked / found.reached)} of them otherwise would not"
        text += f", and {counted(found.hopeless, 'pose')} cannot" if found.hopeless else ""
    around = "" if clearance.cell is None else f"; {cell_text(clearance.cell)}"
    return f"{text} ({clearance.capsules.describe(f.a.arm)}{around})"
