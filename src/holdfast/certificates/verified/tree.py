"""The bisection tree of a certificate: cells of its root box, and what part of it they are."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from fractions import Fraction

from .forms import need

Cell = tuple[tuple[int, int], ...]  # for each axis (k, d): the part from k to k + 1 of 2^d equal ones

MOST_LEAVES, MOST_DEPTH = 1 << 24, 200
MOST_STEPS = 1_000_000  # to find what overlapping cells cover
PROVED, SPLIT = 0, 16  # token 2 is undecided; so is 1, refuted, as a reach of version 1 holds no refutations


def cells(tree: bytes, axes: int, last: int = 2, locks: int = 256) -> Iterator[tuple[int, Cell]]:
    """Token and cell of each leaf, in the order of the tree; tokens up to the last are those of leaves, and from ``locks``."""
    waiting: list[Cell] = [((0, 0),) * axes]
    for token in tree:
        need(waiting, "the tree goes on behind its end")
        cell, axis = waiting.pop(), token - SPLIT
        if token <= last or token >= locks:
            yield token, cell
            continue
        good = 0 <= axis < axes and sum(d for _, d in cell) < MOST_DEPTH
        need(good, f"token {token} is unknown, or the tree deeper than {MOST_DEPTH}")
        (k, d), after = cell[axis], cell[axis + 1 :]
        waiting += [(*cell[:axis], (2 * k + upper, d + 1), *after) for upper in (1, 0)]
    need(not waiting, "the tree ends early")


def volume(parts: Iterable[Cell]) -> Fraction:
    """What part of the root box cells are."""
    return sum((Fraction(1, 1 << sum(d for _, d in cell)) for cell in parts), Fraction(0))


def covered(parts: Collection[Cell], steps: list[int]) -> Fraction:
    """What part of the root box cells cover that may overlap; something above that once ``steps`` (one number) are spent."""
    steps[0] -= len(parts)
    if len(parts) < 2 or steps[0] < 0 or any(not any(d for _, d in cell) for cell in parts):
        return min(Fraction(1), volume(parts))
    axis = min(range(len(next(iter(parts)))), key=lambda a: sum(cell[a][1] == 0 for cell in parts))
    halves: tuple[set[Cell], set[Cell]] = set(), set()
    for cell in parts:
        (k, d), before, after = cell[axis], cell[:axis], cell[axis + 1 :]
        for upper in (0, 1) if d == 0 else (k >> (d - 1),):
            halves[upper].add((*before, (k - (upper << (d - 1)), d - 1) if d else (0, 0), *after))
    return (covered(halves[0], steps) + covered(halves[1], steps)) / 2
