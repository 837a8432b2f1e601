"""Records and their checks, and arms made from null spaces, in numbers and words."""

from __future__ import annotations

from typing import Any

import numpy as np

from holdfast.arms.dh_file import text
from holdfast.arms.dh_rows import dh_table
from holdfast.designs.book.entries import Book, Record, RecordCheck
from holdfast.designs.judging.orders import Orders
from holdfast.designs.synthesis.arms import Synthesis
from holdfast.present.printing import Rows
from holdfast.words import percent

Shown = Book | Record | RecordCheck | Synthesis | Orders

_BEST = 10  # orders in a table
_HEAD = ["record", "task", "joints", "locked", "value", "no arm can beat", "by", "gap"]


def row(r: Record) -> list[str]:
    """A record in a line of a table."""
    c, bound = r.data.kind, r.data.proven_bound
    task, gap = c.task or f"any of {c.rows} rows", "0" if r.gap < 1e-8 else percent(r.gap)
    return [r.id, task, f"{c.joints}", f"{c.failures}", r.amount, f"{bound.value:.7g}", bound.by, gap]


def to_dict(found: Shown) -> dict[str, Any]:
    """What the file says; of a check each claim; of a synthesis the tables."""
    if isinstance(found, Book):
        return {"records": [to_dict(r) for r in found.values()]}
    if isinstance(found, Record):
        return found.data.model_dump(by_alias=True, exclude_none=True)
    if isinstance(found, RecordCheck):
        return {"record": found.record.id, "ok": found.ok, "claims": [{"said": s, "holds": h} for s, h in found.claims]}
    if isinstance(found, Orders):
        numbers = {"samples": found.samples, "seed": found.seed, "at_home": found.at_home, "thresholds": list(found.thresholds)}
        return (
            numbers
            | {"orders": found.orders.tolist(), "fractions": found.fractions.tolist(), "mean": found.mean.tolist()}
            | {
                "lengths": found.lengths.tolist(),
                "front": found.front.tolist(),
                "fresh": found.fresh.tolist(),
            }
        )
    tables = [text(dh_table(arm), arm.name) for arm in found.arms]
    numbers = {"task": found.task, "failures": found.failures, "value": found.value, "bound": found.bound}
    return numbers | {"residual": found.residual, "losses": found.losses, "tables": tables}


def tables(found: Shown) -> list[Rows]:
    """A row for each record or arm."""
    if isinstance(found, Book):
        return [Rows(_HEAD, [row(r) for r in found.values()])]
    if isinstance(found, Orders):
        best = found.mean.argsort()[::-1][:_BEST]
        head = ["order", *(f"at least {h:g}" for h in found.thresholds), "mean"]
        shown = [[" ".join(str(k + 1) for k in found.orders[d]), *map(percent, found.fractions[d])] for d in best]
        return [Rows(head, [[*cells, f"{found.mean[d]:.4f}"] for d, cells in zip(best, shown, strict=True)], "best means")]
    if isinstance(found, Synthesis):
        rows = []
        for k, (arm, loss) in enumerate(zip(found.arms, found.losses, strict=True), 1):
            table = dh_table(arm).rows
            condition = np.linalg.cond(arm.jacobian(np.zeros(arm.n)))
            lengths = sum(abs(r.a) + abs(r.d) for r in table[:-1])
            rows.append([f"{k}", f"{found.value - loss:.6g}", f"{loss:.1e}", f"{condition:.3g}", f"{lengths:.3f}"])
        return [Rows(["arm", "value", "lost by rounding", "condition", "sum of |a| and |d|, m"], rows)]
    return []


def key_table(found: Shown) -> Rows:
    """The same for notebooks."""
    if isinstance(found, Record):
        return Rows(_HEAD, [row(found)])
    if isinstance(found, RecordCheck):
        return Rows(["claim", "holds"], [[said, "yes" if holds else "no"] for said, holds in found.claims])
    return tables(found)[0]


def next_steps(found: Shown, name: str) -> list[str]:
    """What one does with it."""
    if isinstance(found, Book):
        return [f'{name}["pose-9R-k2-001"].check()  # measures it again']
    if isinstance(found, Record):
        return [f"{name}.check()  # measures it again"]
    if isinstance(found, RecordCheck):
        return [f"{name}.ok  # every claim holds"]
    if isinstance(found, Orders):
        return [f"{name}.interval({int(found.mean.argmax())}, 0)  # of the order with the best mean, at the first threshold"]
    return [f"hf.arms.dh_table({name}.arms[0])  # to build it"]
