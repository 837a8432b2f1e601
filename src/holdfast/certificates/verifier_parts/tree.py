"""Bisection tree of a certificate: cells of its root box, and the fraction of the box that they fill."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from fractions import Fraction

from .forms import require

Cell = tuple[tuple[int, int], ...]  # for each axis (k, d): part k, from 0, of 2^d equal parts

MAX_LEAVES = 1 << 24
MAX_DEPTH = 200
MAX_COVER_STEPS = 1_000_000  # steps to compute the volume that overlapping cells cover
PROVED_TOKEN = 0  # token 2 marks undecided cells
FIRST_LOCK_TOKEN = 128  # token in a ceiling of a leaf that a lock of the first joint proves
REFUTED_TOKEN = 255  # token in a hold claim of a cell in which some joint moves
SPLIT_TOKEN = 16  # token 1, refuted, counts as undecided, too, because a reach of version 1 contains no refutations


def iterate_cells(tree: bytes, axes: int, last_leaf_token: int = 2, first_lock_token: int = 256) -> Iterator[tuple[int, Cell]]:
    """Yield token and cell of each leaf in tree order.

    Leaf tokens are those up to ``last_leaf_token`` and from ``first_lock_token`` on.
    """
    waiting: list[Cell] = [((0, 0),) * axes]
    for token in tree:
        require(waiting, "the tree continues after its end")
        cell, axis = waiting.pop(), token - SPLIT_TOKEN
        if token <= last_leaf_token or token >= first_lock_token:
            yield token, cell
            continue
        is_valid = 0 <= axis < axes and sum(d for _, d in cell) < MAX_DEPTH
        require(is_valid, f"token {token} is unknown, or the tree deeper than {MAX_DEPTH}")
        (k, d), later_axes = cell[axis], cell[axis + 1 :]
        waiting += [(*cell[:axis], (2 * k + upper, d + 1), *later_axes) for upper in (1, 0)]
    require(not waiting, "the tree ends early")


def compute_disjoint_volume(parts: Iterable[Cell]) -> Fraction:
    """Return the fraction of the root box that disjoint cells fill."""
    return sum((Fraction(1, 1 << sum(d for _, d in cell)) for cell in parts), Fraction(0))


def compute_covered_volume(parts: Collection[Cell], remaining_steps: list[int]) -> Fraction:
    """Return the fraction of the root box that overlapping cells cover, or an upper bound.

    The result is an upper bound if the number in ``remaining_steps`` does not suffice.
    """
    remaining_steps[0] -= len(parts)
    if len(parts) < 2 or remaining_steps[0] < 0 or any(not any(d for _, d in cell) for cell in parts):
        return min(Fraction(1), compute_disjoint_volume(parts))
    axis = min(range(len(next(iter(parts)))), key=lambda a: sum(cell[a][1] == 0 for cell in parts))
    halves: tuple[set[Cell], set[Cell]] = set(), set()
    for cell in parts:
        (k, d), earlier_axes, later_axes = cell[axis], cell[:axis], cell[axis + 1 :]
        for upper in (0, 1) if d == 0 else (k >> (d - 1),):
            halves[upper].add((*earlier_axes, (k - (upper << (d - 1)), d - 1) if d else (0, 0), *later_axes))
    return (compute_covered_volume(halves[0], remaining_steps) + compute_covered_volume(halves[1], remaining_steps)) / 2
