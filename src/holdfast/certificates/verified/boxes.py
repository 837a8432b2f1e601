"""Boxes of joints and of targets, cells of the tree: their middles, and what a number may lose over one of them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import numpy as np

from .balls import LEAST, UP, Balls, flint
from .chain import Array, Chain, turned
from .forms import need, real
from .tree import Cell


class Boxes(Chain):
    """The axes of a tree, between the ends of the root box, and the arm that they are about."""

    def __init__(self, arm: dict[str, Any], ends: list[list[str]] | list[list[float]], flat: bool) -> None:
        super().__init__(arm, flat)
        numbers = [[Fraction(real(x) if isinstance(x, str) else x) for x in pair] for pair in ends]
        self.low, self.width = [low for low, _ in numbers], [high - low for low, high in numbers]
        self._known: dict[tuple[int, int, int], list[float]] = {}

    def middles(self, axis: int, cells: Iterable[Cell]) -> Array:
        """Of cells, along one axis, what :func:`turned` gives of their middles, with their half widths, rounded up (N, 5)."""
        found = []
        for cell in cells:
            k, d = part = cell[axis]
            if (axis, *part) not in self._known:
                given = turned(self.low[axis] + self.width[axis] * Fraction(2 * k + 1, 2 << d))
                given[2] = math.nextafter(float(self.width[axis] / (2 << d)), math.inf)
                self._known[axis, k, d] = given
            found.append(self._known[axis, k, d])
        return np.array(found)

    def at(self, q: list[str]) -> list[Array]:
        """Joint values, one row for each, as :meth:`moved` takes them."""
        values = [real(x) for x in q]
        need(max(map(abs, values)) < 100, "a configuration turns by more than 100 rad")
        return [np.array([[x, 0, 0, *(float(y) for y in flint.arb(x).sin_cos())]]) for x in values]


def bent(slope: Array, second: Balls, half: Array) -> Array:
    """Above what slopes (their sizes) and second derivatives, by pairs j <= k, take from a number within half widths."""
    own, pairs = np.diagonal(second.low, axis1=1, axis2=2), np.triu(second.size, 1)
    most = np.where(slope < own * half, slope**2 / (2 * own), slope * half - own * half**2 / 2)
    return np.asarray((most.sum(axis=1) + np.einsum("nj,njk,nk->n", half, pairs, half)) * UP + LEAST)
