"""How often the arm collides with itself, and what it was taken to be."""

from __future__ import annotations

from collections import Counter

import numpy as np

from holdfast.clearance.clearance import Clearance
from holdfast.present.assessment.facts import Facts
from holdfast.report.page import Block, Callout, Table, Text
from holdfast.words import counted, percent, share

TITLE = "Does the arm collide with itself?"
_MOST_NAMED = 6  # pairs that are not checked, by name


def blocks(f: Facts) -> list[Block]:
    """How often the arm collides with itself; that nobody looked, if the run chose configurations without looking."""
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
    facts = [("Configurations found that bring the arm into collision with itself", share(found.found, found.reached))]
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
        facts.append(("Closest where the arm collides with itself", closest))
    facts += [
        ("Capsules", capsules.describe(arm)),
        ("Checked", counted(len(clearance.pairs), "pair") + " of capsules"),
        ("Not checked", _ignored(clearance)),
    ]
    blocks.append(Table([[k, v] for k, v in facts], caption=f"Of the {found.reached:,} {f.reached}, not weighted."))
    text = (
        "Links are named by the joint that moves them. The clearance is the smallest distance between capsules that could meet."
    )
    return [*blocks, Text(text, quiet=True)]


def _closest(f: Facts, clearance: Clearance) -> str:
    """The pair that is closest most often where the arm collides with itself, or nothing."""
    if f.rows is None:
        return ""
    q = f.rows.q[f.rows.reached]
    q = q[clearance(q) < 0]
    if not len(q):
        return ""
    counts = np.bincount(clearance.closest_pair(q), minlength=len(clearance.pairs))
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
    text = f"{percent(found.found / found.reached)} of the configurations found"
    if f.a.optimised is not None:
        kept = f"keep a clearance of {found.margin:g} m" if found.margin else "keep the arm clear of itself"
        text += f"; the best configurations {kept}, which {percent(found.blocked / found.reached)} of them otherwise would not"
        text += f", and {counted(found.hopeless, 'pose')} cannot" if found.hopeless else ""
    return f"{text} ({clearance.capsules.describe(f.a.arm)})"
