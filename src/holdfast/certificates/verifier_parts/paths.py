"""Contents of path certificates: slabs of lock instants with their cells, refuted intervals, and the fractions that
they cover.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .forms import (
    FRACTION_PATTERN,
    LIMITS_FORM,
    NUMBER_PATTERN,
    TASK_FORMS,
    TEXT_PATTERN,
    VOLUMES_FORM,
    decompress_payload,
    format_intervals,
    parse_hex,
    require,
    require_task,
)
from .tree import MAX_LEAVES, Cell, iterate_cells

Ints = NDArray[np.int64]
StoredSlab = tuple[
    int, tuple[int, int], Ints, Ints
]  # the lock; the ends of the slab; start, end and half width of its cells; their centres
StoredRefutation = tuple[int, tuple[int, int], int, list[tuple[int, Cell]]]  # lock; interval; path instant; leaves of the tree

SEGMENT_INSTANTS = 1 << 20  # instants
PATH_CENTER_UNIT = 2.0**-28  # rad
MAX_CELLS = 1 << 24
MAX_PATH_JOINTS = 32
MAX_SEGMENTS = 1 << 14


def measure_coverage(spans: Iterable[tuple[int, int]], document: dict[str, Any]) -> Fraction:
    """Return the fraction of the claimed lock instants that intervals cover; intervals may overlap."""
    (first, last), total, reached = document["during"], 0, 0
    for begin, stop in sorted(spans):
        total, reached = total + max(0, stop - max(begin, reached)), max(stop, reached)
    return Fraction(total, last - first)


def find_uncovered_intervals(spans: Iterable[tuple[int, int]], document: dict[str, Any]) -> list[tuple[int, int]]:
    """Return the gaps between intervals among the claimed lock instants."""
    (reached, last), uncovered = document["during"], []
    for begin, stop in sorted(spans):
        uncovered += [(reached, begin)] * (begin > reached)
        reached = max(reached, stop)
    return uncovered + [(reached, last)] * (last > reached)


def format_fraction(fraction: Fraction) -> str:
    """Format a fraction as the file contains it."""
    return f"{fraction.numerator}/{fraction.denominator}"


def format_worst_fractions(parts: list[tuple[Fraction, Fraction]]) -> dict[str, str]:
    """Return the smallest proved, and the largest refuted and undecided fractions of locks with (proved, refuted) fractions."""
    min_proved, max_refuted = min(proved for proved, _ in parts), max(refuted for _, refuted in parts)
    max_undecided = max(1 - proved - refuted for proved, refuted in parts)
    volumes = {"proved": min_proved, "refuted": max_refuted, "undecided": max_undecided}
    return {key: format_fraction(fraction) for key, fraction in volumes.items()}


def read_slabs(document: dict[str, Any]) -> Iterator[StoredSlab]:
    """Yield the slabs of all locks in order.

    Raise an error unless each slab is complete, within the claim and behind the previous slab.
    """
    first, last = document["during"]
    path_end, n = (len(document["knots"]) - 1) * SEGMENT_INSTANTS, len(document["arm"]["joints"])
    for lock_index, lock in enumerate(document["locks"]):
        packed = decompress_payload(lock["cells"], 8 * 4 * MAX_CELLS, "cells")
        require(len(packed) % 8 == 0, "cells are truncated")
        numbers = np.frombuffer(packed, "<i8").astype(np.int64)
        payload = decompress_payload(lock["centres"], 4 * n * MAX_CELLS, "centres")
        require(len(payload) % (4 * n) == 0, "centres are truncated")
        rows, cursor, used, earliest = np.frombuffer(payload, "<i4").reshape(-1, n).astype(np.int64), 0, 0, first
        require(not rows[:, lock["followers"]].any(), "centres of joints that follow must be 0")
        while cursor < len(numbers):
            begin, stop, count = (int(x) for x in numbers[cursor : cursor + 3]) if cursor + 3 <= len(numbers) else (0, 0, 0)
            encoded_ends = numbers[cursor + 3 : cursor + 3 + max(count, 0)]
            is_valid = earliest <= begin < stop <= last and (stop - 1) // SEGMENT_INSTANTS == begin // SEGMENT_INSTANTS
            require(is_valid and 0 < count == len(encoded_ends), "a slab of lock instants is out of place, or without cells")
            require(used + count <= len(rows), "there are fewer centres than cells")
            slab_centers = rows[used : used + count].copy()
            slab_cells = _decode_cells(begin, encoded_ends, slab_centers[:, lock["joint"]])
            slab_centers[:, lock["joint"]] = 0
            is_valid = (slab_cells[:, 2] == 0).all() or not any(map(parse_hex, document["tube"]))
            require(is_valid, "a tube must not have turned cells")
            require(slab_cells[-1, 1] == path_end and not slab_cells[-1, 2], "cells of a slab end before the path")
            require(slab_cells[0, 2] or slab_cells[0, 1] >= stop, "the first cell of a slab does not hold it")
            yield lock_index, (begin, stop), slab_cells, slab_centers
            cursor, used, earliest = cursor + 3 + count, used + count, stop
        require(used == len(rows), "centres are left over")


def read_refutations(document: dict[str, Any]) -> Iterator[StoredRefutation]:
    """Yield, for all locks in order, the intervals of lock instants that are refuted at a later path instant."""
    first, last = document["during"]
    for lock_index, lock in enumerate(document["locks"]):
        earliest = first
        for entry in lock["refutations"]:
            begin, stop, path_instant = (entry[key] for key in ("begin", "stop", "at"))
            is_valid = earliest <= begin < stop <= min(last, path_instant)
            is_valid = is_valid and (stop - 1) // SEGMENT_INSTANTS == begin // SEGMENT_INSTANTS
            require(is_valid, "a refuted interval of lock instants is out of place")
            tree = decompress_payload(entry["tree"], 2 * MAX_LEAVES, "tree of a refutation")
            cells = list(iterate_cells(tree, len(document["arm"]["joints"]), len(document["pairs"]) - 1))
            yield lock_index, (begin, stop), path_instant, cells
            earliest = stop


def _decode_cells(begin: int, encoded_ends: Ints, encoded_starts: Ints) -> Ints:
    """Return starts, ends and half widths (0 unless tangent) of cells.

    Encoded ends are instants, or negative half widths of tangent cells. Encoded starts are the path positions of some cells.
    """
    is_tangent = encoded_ends < 0
    faces = np.append(begin, np.maximum.accumulate(np.where(is_tangent, begin, encoded_ends)))
    follows_tangent = np.append(False, is_tangent[:-1])
    segment_starts, has_position = faces[:-1] // SEGMENT_INSTANTS * SEGMENT_INSTANTS, is_tangent | follows_tangent
    starts = np.where(has_position, segment_starts + encoded_starts, faces[:-1])
    ends = np.where(is_tangent, starts, encoded_ends)
    require(not encoded_starts[~has_position].any(), "centres of joints that are not free must be 0")
    lengths = starts - segment_starts
    is_valid = (lengths >= is_tangent) & (lengths <= SEGMENT_INSTANTS - ~is_tangent) & (encoded_ends >= -(1 << 31))
    is_valid &= is_tangent | (
        (starts < ends) & ((ends - 1) // SEGMENT_INSTANTS == segment_starts // SEGMENT_INSTANTS) & (ends > faces[:-1])
    )
    require(is_valid.all(), "cells of a slab leave a gap")
    return np.stack([starts, ends, np.where(is_tangent, -encoded_ends, 0)], axis=1)


def path_claim_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys that a path has in addition to the common ones."""
    task = require_task(document)
    count, points = (len(x) if isinstance(x, list) else 0 for x in (document.get("knots"), document.get("points")))
    is_valid = n <= MAX_PATH_JOINTS and 2 <= count <= MAX_SEGMENTS + 1
    require(is_valid, f"a path must have 1 to {MAX_SEGMENTS} segments, and at most {MAX_PATH_JOINTS} joints")
    instant = range((count - 1) * SEGMENT_INSTANTS + 1)
    follower = [range(n), n - 1 - TASK_FORMS[task][0] - TASK_FORMS[task][1]]
    refuted = [dict.fromkeys(("begin", "stop", "at"), instant) | {"tree": TEXT_PATTERN}, ...]
    lock = {"joint": range(n), "followers": follower, "refutations": refuted}
    lock |= {"cells": TEXT_PATTERN, "centres": TEXT_PATTERN, "proved": FRACTION_PATTERN, "refuted": FRACTION_PATTERN}
    form: dict[str, Any] = {"knots": [[NUMBER_PATTERN, n], ...], "tube": [NUMBER_PATTERN, 2], "limits": [LIMITS_FORM, n]}
    form["during"] = [instant, 2]
    form |= {"pairs": [[range(points), 2], ...], "points": [{"link": range(n + 1), "place": [NUMBER_PATTERN, 3]}, ...]}
    volumes = dict.fromkeys(VOLUMES_FORM, FRACTION_PATTERN)
    return form | {"unit": re.escape(PATH_CENTER_UNIT.hex()), "locks": [lock, ...], "volumes": volumes}


def describe_path(document: dict[str, Any], names: list[str]) -> str:
    """Return the claim of a path as a sentence without its end."""
    knots, (first, last), locked = document["knots"], document["during"], [names[lock["joint"]] for lock in document["locks"]]
    metres, radians = map(parse_hex, document["tube"])
    knots_digest = hashlib.sha256(json.dumps(knots, separators=(",", ":")).encode()).hexdigest()[:12]
    text = f"The healthy arm moves along {len(knots) - 1} straight segments between configurations {knots_digest}. "
    text += f"For every instant from knot {first / SEGMENT_INSTANTS!r} to knot {last / SEGMENT_INSTANTS!r} at which one of "
    text += f"{', '.join(locked)} locks where it is, one continuous motion within "
    text += f"the limits ({format_intervals(names, document['limits'])}) begins there with that joint at rest and takes "
    text += f"the tool along the rest of the {document['task']} path"
    if metres or radians:
        angle_note = f" and {radians!r} rad" if "pose" in document["task"] else ""
        text += f", or along any continuous path that is within {metres!r} m{angle_note} of it and begins on it"
    return f"{text}; angles in rad,"
