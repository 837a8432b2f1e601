"""Cells that are turned along the motion of a locked arm, where that is singular: of many slabs side by side."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.tool_paths.cells import SEGMENT, UNIT, Cells, Forms
from holdfast.certificates.tool_paths.forms import Following
from holdfast.certificates.tool_paths.slabs import Slab

Ints = NDArray[np.int64]
Found = tuple[list[int], list[Ints], Forms]  # ends, centres, and what is found in the last cell

PLAIN = 2  # halvings of a slab before its cells are turned
_TURNED, _REACH = 24, 0.8  # cells in a row; the middle of one, in half widths ahead
_WIDTHS = 0.5 * 0.5 ** np.arange(16)  # half widths


def led(f: Following, slabs: Sequence[Slab]) -> list[Found | None]:
    """Turned cells behind what each slab has, and one behind them that is not; None: there are none."""
    found: list[Found | None] = [None] * len(slabs)
    if not slabs:
        return found
    none = Forms.none(f.n, f.m, 2 + len(f.tube) + f.m)
    begin, stop, at = (np.array([getattr(slab, key) for slab in slabs]) for key in ("begin", "stop", "at"))
    base, first = at // SEGMENT * SEGMENT, np.array([not slab.ends for slab in slabs])
    before = Forms.stacked([slab.found or none for slab in slabs])
    q, place = f.end(before)
    q[first], place[first] = f.healthy(begin + stop, stop)[0][first], ((begin + stop) / (2 * SEGMENT))[first]
    made = [(list[int](), list[Ints]()) for _ in slabs]
    left = np.arange(len(slabs))
    for _ in range(_TURNED):
        own, by = np.repeat(left, len(_WIDTHS)), np.tile(_WIDTHS, len(left))
        middles, places = f.ahead(q[own], place[own], base[own], _REACH * by)
        some = np.flatnonzero((places > base[own]) & (places <= base[own] + SEGMENT))
        own, middles, places, width = own[some], middles[some], places[some], np.rint(by[some] / UNIT).astype(np.int64)
        cells = Cells(begin[own], stop[own], places, places, width)
        forms = f.forms(f.placed(middles, cells), cells)
        good = np.flatnonzero(forms.good & np.where(first[own], f.begins(forms, cells), f.goes_on(before.take(own), forms)))
        left, widest = np.unique(own[good], return_index=True)
        if not left.size:
            break
        chosen = good[widest]
        now = forms.take(chosen)
        before, first[left] = before.put(left, now), False
        for k, which in zip(left.tolist(), chosen.tolist(), strict=True):
            made[k][0].append(-int(width[which]))
            made[k][1].append(_row(f, forms.q[which], int(places[which] - base[k])))
        straight = _straight(f, (begin[left], stop[left]), base[left], now)
        for k, last in zip(left.tolist(), straight, strict=True):
            if last is not None:
                form, start, end = last
                found[k] = [*made[k][0], end], [*made[k][1], _row(f, form.q[0], start - int(base[k]))], form
        left = np.array([k for k in left.tolist() if found[k] is None], dtype=np.int64)
        q, place = f.end(before)
    return found


def _straight(f: Following, lock: tuple[Ints, Ints], base: Ints, before: Forms) -> list[tuple[Forms, int, int] | None]:
    """The longest cells that are not turned behind some that are, with their starts and ends; None: there is none."""
    q, place = f.end(before)
    spread = np.abs(before.own[:, -1, 0]) * before.half[:, 0] + (np.abs(before.own[:, -1, 2:]) * before.half[:, 2:]).sum(axis=1)
    low = np.floor((place - 1.01 * spread) * SEGMENT).astype(np.int64)
    high = np.floor((place + 1.01 * spread) * SEGMENT).astype(np.int64) + 1
    start, own, ends = np.maximum(low - 1, base), list[int](), list[int]()
    for k, (a, b, last) in enumerate(zip(low.tolist(), high.tolist(), (base + SEGMENT).tolist(), strict=True)):
        tries = {min((b >> d) + 1 << d, last) for d in range(max(1, (b - a).bit_length() - 1), 20)}
        mine = sorted(end for end in tries if end > b)
        own, ends = own + [k] * len(mine), ends + mine
    found: list[tuple[Forms, int, int] | None] = [None] * len(low)
    if own:
        of = np.array(own)
        cells = Cells(lock[0][of], lock[1][of], start[of], np.array(ends), np.zeros(len(of), dtype=np.int64))
        forms = f.forms(f.solved(q[of], cells), cells)
        for k in np.flatnonzero(forms.good & f.goes_on(before.take(of), forms)).tolist():
            found[own[k]] = forms.take(np.array([k])), int(start[own[k]]), ends[k]
    return found


def _row(f: Following, q: NDArray[np.float64], place: int) -> Ints:
    """A centre as the file has it."""
    row = np.round(q / UNIT).astype(np.int64)
    row[f.still] = 0
    row[f.still[0]] = place
    return np.asarray(row)
