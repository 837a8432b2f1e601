"""What files of paths hold: slabs of lock instants, and cells behind each; and what part of the instants that is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .forms import need, real, unpacked
from .tree import MOST_LEAVES, Cell, cells

Ints = NDArray[np.int64]
Slab = tuple[int, tuple[int, int], Ints, Ints]  # the lock; its ends; of its cells start, end and half width; their centres
Never = tuple[int, tuple[int, int], int, list[tuple[int, Cell]]]  # the lock; its ends; the place; leaves of the tree

SEGMENT, UNIT = 1 << 20, 2.0**-28  # instants; rad
MOST_CELLS = 1 << 24


def share(spans: Iterable[tuple[int, int]], document: dict[str, Any]) -> Fraction:
    """What intervals cover of the lock instants that are claimed; they may overlap."""
    (first, last), total, reached = document["during"], 0, 0
    for begin, stop in sorted(spans):
        total, reached = total + max(0, stop - max(begin, reached)), max(stop, reached)
    return Fraction(total, last - first)


def gaps(spans: Iterable[tuple[int, int]], document: dict[str, Any]) -> list[tuple[int, int]]:
    """Where none of some intervals is, among the lock instants that are claimed."""
    (at, last), left = document["during"], []
    for begin, stop in sorted(spans):
        left += [(at, begin)] * (begin > at)
        at = max(at, stop)
    return left + [(at, last)] * (last > at)


def text(part: Fraction) -> str:
    """As the file writes it."""
    return f"{part.numerator}/{part.denominator}"


def volumes(parts: list[tuple[Fraction, Fraction]]) -> dict[str, str]:
    """What is proved at least, refuted and undecided at most, of the lock of each joint: (proved, refuted)."""
    least, most = min(a for a, _ in parts), max(b for _, b in parts)
    return {"proved": text(least), "refuted": text(most), "undecided": text(max(1 - a - b for a, b in parts))}


def slabs(document: dict[str, Any]) -> Iterator[Slab]:
    """Of all locks, in order; refused unless each is whole, within the claim and behind the one before."""
    first, last = document["during"]
    end, n = (len(document["knots"]) - 1) * SEGMENT, len(document["arm"]["joints"])
    for which, lock in enumerate(document["locks"]):
        packed = unpacked(lock["cells"], 8 * 4 * MOST_CELLS, "cells")
        need(len(packed) % 8 == 0, "cells are cut off")
        numbers = np.frombuffer(packed, "<i8").astype(np.int64)
        centres = unpacked(lock["centres"], 4 * n * MOST_CELLS, "centres")
        need(len(centres) % (4 * n) == 0, "centres are cut off")
        rows, at, used, after = np.frombuffer(centres, "<i4").reshape(-1, n).astype(np.int64), 0, 0, first
        need(not rows[:, lock["followers"]].any(), "centres of joints that follow must be 0")
        while at < len(numbers):
            begin, stop, count = (int(x) for x in numbers[at : at + 3]) if at + 3 <= len(numbers) else (0, 0, 0)
            given = numbers[at + 3 : at + 3 + max(count, 0)]
            good = after <= begin < stop <= last and (stop - 1) // SEGMENT == begin // SEGMENT
            need(good and 0 < count == len(given), "a slab of lock instants is out of place, or without cells")
            need(used + count <= len(rows), "there are fewer centres than cells")
            some = rows[used : used + count].copy()
            cells = _cells(begin, given, some[:, lock["joint"]])
            some[:, lock["joint"]] = 0
            need((cells[:, 2] == 0).all() or not any(map(real, document["tube"])), "in a tube there are no turned cells")
            need(cells[-1, 1] == end and not cells[-1, 2], "cells of a slab end before the path")
            need(cells[0, 2] or cells[0, 1] >= stop, "the first cell of a slab does not hold it")
            yield which, (begin, stop), cells, some
            at, used, after = at + 3 + count, used + count, stop
        need(used == len(rows), "centres are left over")


def refutations(document: dict[str, Any]) -> Iterator[Never]:
    """Of all locks, in order, intervals of lock instants that are refuted at a later place of the path."""
    first, last = document["during"]
    for which, lock in enumerate(document["locks"]):
        after = first
        for one in lock["refutations"]:
            begin, stop, at = (one[key] for key in ("begin", "stop", "at"))
            good = after <= begin < stop <= min(last, at) and (stop - 1) // SEGMENT == begin // SEGMENT
            need(good, "a refuted interval of lock instants is out of place")
            tree = unpacked(one["tree"], 2 * MOST_LEAVES, "tree of a refutation")
            yield which, (begin, stop), at, list(cells(tree, len(document["arm"]["joints"]), len(document["pairs"]) - 1))
            after = stop


def _cells(begin: int, given: Ints, placed: Ints) -> Ints:
    """Starts, ends and half widths (0 unless turned) of cells, from their ends or negative half widths, and places of some."""
    turned = given < 0
    faces = np.append(begin, np.maximum.accumulate(np.where(turned, begin, given)))
    behind = np.append(False, turned[:-1])
    base, free = faces[:-1] // SEGMENT * SEGMENT, turned | behind
    starts = np.where(free, base + placed, faces[:-1])
    ends = np.where(turned, starts, given)
    need(not placed[~free].any(), "centres of joints that are not free must be 0")
    good = (starts - base >= turned) & (starts - base <= SEGMENT - ~turned) & (given >= -(1 << 31))
    good &= turned | ((starts < ends) & ((ends - 1) // SEGMENT == base // SEGMENT) & (ends > faces[:-1]))
    need(good.all(), "cells of a slab leave a gap")
    return np.stack([starts, ends, np.where(turned, -given, 0)], axis=1)
