"""Which joint deserves to be kept from failing."""

from __future__ import annotations

from holdfast.assessment.upgrade import MOST_OPTIMISED_AGAIN, Upgrade
from holdfast.present.assessment.console import best_upgrades
from holdfast.present.assessment.facts import Facts
from holdfast.report.page import Block, Table, Text

TITLE = "Which joint deserves a redundant motor or brake"
_MOST_ROWS = 40


def blocks(f: Facts) -> list[Block]:
    """Which joint deserves a redundant motor or brake."""
    if not f.d.reached or not f.decided:
        return []
    if f.rows is None:
        return [Text("The poses of this run were not kept, so the report cannot say which joint deserves it.")]
    ranked = f.a.upgrades(f.threshold)
    if not ranked:
        return []
    best = {u.joint: u for u in best_upgrades(f.a, f.threshold)}
    first = ranked[0]
    if first.gain > 0:
        text = (
            f"{first.joint}: if it could never fail, P({f.condition}) would rise from {first.before:.3f} to {first.after:.3f}."
        )
    else:
        text = f"None by itself: if any one joint could never fail, P({f.condition}) would still be {first.before:.3f}."
    number_of = {name: k + 1 for k, name in enumerate(f.a.arm.joint_names)}
    rows = []
    for u in ranked[:_MOST_ROWS]:
        row = [f"{number_of[u.joint]}  {u.joint}", f"{u.after:.3f}", paired(u)]
        if u.joint in best:
            row += [f"{best[u.joint].after:.3f}", paired(best[u.joint])]
        rows.append(row)
    head = ["If this never fails", f"P({f.condition})", "gain, 95 % interval"]
    caption = f"Now: {first.before:.3f}"
    note = (
        "Suppose that a redundant motor or brake keeps one joint from failing: the worst case is then over the failures in "
        f"which it has no part, at the same {f.noun}s and configurations. The intervals of the gains are paired: a gain is the "
        f"fraction of all {f.d.samples:,} {f.noun}s that fail now and would not then."
    )
    if best:
        head += ["after optimisation", "gain, 95 % interval"]
        caption += f"; after optimisation {next(iter(best.values())).before:.3f}"
        count = min(f.d.samples, MOST_OPTIMISED_AGAIN)
        which = "" if count == f.d.samples else f" of the first {count:,} {f.noun}s"
        note += f" After optimisation: the configurations{which} are optimised again for the failures that remain."
    return [
        Text(text),
        Table(rows, head, frozenset(range(1, len(head))), caption=caption + ".", wide=True),
        Text(note, quiet=True),
    ]


def paired(u: Upgrade) -> str:
    """A gain with its interval."""
    return f"{u.gain:+.3f} ({u.low:.3f} to {u.high:.3f})" if u.gain else f"0 (up to {u.high:.3f})"
