"""Structural zeros: all axes before a joint meet in one point, and all behind it in another; checked in rationals.

A force along the line through both points has no moment about any other axis, so a lock of the joint costs everything, or the
arm is singular.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from typing import Any

from .balls import UP
from .chain import Boxes, Leaf
from .forms import need, real
from .tree import Cell


class Meeting(Boxes):
    """Pairs of neighbouring axes, before the joint and behind it: each has the point in common that both name."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document, [])

    def leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """How many there are, none undecided, and the leaves, each with the later axis."""
        pairs = [i for i in range(1, len(document["snapped"])) if i not in (document["locked"], document["locked"] + 1)]
        return len(pairs), [], lambda: (((), i) for i in pairs)

    def unproved(self, rejected: list[Leaf], leaves: Callable[[], Iterator[Leaf]]) -> list[Cell]:
        """Everything, if one is."""
        return [cell for cell, _ in rejected[:1]]

    def proves(self, kind: int, leaves: list[Leaf]) -> list[bool]:
        """Whether a pair has."""
        frame, points = self._given["snapped"][kind], [Fraction(x) for x in self._given["points"]]
        turn = exact_rotation(map(int, frame["rotation"]))
        place = [Fraction(x) + row[2] * points[kind] for x, row in zip(frame["origin"], turn, strict=True)]
        return [place == [0, 0, points[kind - 1]]]


def exact_rotation(quaternion: Iterable[int]) -> list[list[Fraction]]:
    """The rotation of a quaternion (w, x, y, z) of whole numbers, of any length but 0."""
    w, x, y, z = quaternion
    rows = [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]  # fmt: skip
    return [[Fraction(value, w * w + x * x + y * y + z * z) for value in row] for row in rows]


def snap(document: dict[str, Any]) -> tuple[float, float]:
    """Above the angle, rad, and the distance, m, between frames of a structural zero and those of the file."""
    turned, shifted = 0.0, 0.0
    for frame, joint in zip(document["snapped"], document["arm"]["joints"], strict=True):
        exact = [x for row in exact_rotation(map(int, frame["rotation"])) for x in row]
        off = sum((a - Fraction(real(b))) ** 2 for a, b in zip(exact, joint["rotation"], strict=True))
        need(off < Fraction(1, 10_000), "a frame is turned by more than some hundredths of a radian")
        # |R - R'| (Frobenius) is 2 sqrt 2 sin(angle / 2); the sine of a small x is above x (1 - x^2 / 6).
        turned = max(turned, math.sqrt(off) / math.sqrt(2) * 1.0001)
        far = sum((Fraction(a) - Fraction(real(b))) ** 2 for a, b in zip(frame["origin"], joint["origin"], strict=True))
        shifted = max(shifted, math.sqrt(far) * UP)
    return turned, shifted
