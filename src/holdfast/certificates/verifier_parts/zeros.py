"""Verification of structural zeros in rational arithmetic: the axes before a joint meet in one point, those behind it in
another.

A force along the line through both points has no moment about any of these axes. A lock of the joint therefore removes all
relative manipulability, or the arm is singular.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from typing import Any

from .balls import ROUND_UP
from .chain import Leaf, LeafVerifier
from .forms import INTEGER_PATTERN, RATIONAL_PATTERN, parse_hex, require, require_revolute, round_to_two_digits
from .tree import Cell


class StructuralZeroVerifier(LeafVerifier):
    """Verifier of pairs of neighbouring axes, before the joint and behind it, that must share the given point."""

    def __init__(self, document: dict[str, Any]) -> None:
        super().__init__(document, [])

    def read_leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """Return the number of leaves, an empty list of undecided cells, and an iterator of leaves with their later axis."""
        later_axes = [
            axis for axis in range(1, len(document["snapped"])) if axis not in (document["locked"], document["locked"] + 1)
        ]
        return len(later_axes), [], lambda: (((), axis) for axis in later_axes)

    def find_unproved_cells(self, rejected: list[Leaf], leaves: Callable[[], Iterator[Leaf]]) -> list[Cell]:
        """Return the whole box if any leaf is rejected."""
        return [cell for cell, _ in rejected[:1]]

    def verify_leaves(self, kind: int, leaves: list[Leaf]) -> list[bool]:
        """Return flags of the leaves whose pair of axes shares its point."""
        frame, points = self._document["snapped"][kind], [Fraction(number) for number in self._document["points"]]
        rotation = rotation_from_quaternion(map(int, frame["rotation"]))
        meeting_point = [Fraction(x) + row[2] * points[kind] for x, row in zip(frame["origin"], rotation, strict=True)]
        return [meeting_point == [0, 0, points[kind - 1]]]


def rotation_from_quaternion(quaternion: Iterable[int]) -> list[list[Fraction]]:
    """Return the rotation of an integer quaternion (w, x, y, z) of any nonzero length."""
    w, x, y, z = quaternion
    rows = [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]  # fmt: skip
    return [[Fraction(value, w * w + x * x + y * y + z * z) for value in row] for row in rows]


def bound_frame_errors(document: dict[str, Any]) -> tuple[float, float]:
    """Bound the angle, rad, and the distance, m, between the frames of a structural zero and those of the file."""
    rotation_error, position_error = 0.0, 0.0
    for frame, joint in zip(document["snapped"], document["arm"]["joints"], strict=True):
        exact = [number for row in rotation_from_quaternion(map(int, frame["rotation"])) for number in row]
        squared_error = sum((x - Fraction(parse_hex(y))) ** 2 for x, y in zip(exact, joint["rotation"], strict=True))
        require(squared_error < Fraction(1, 10_000), "a frame is rotated by more than a few hundredths of a radian")
        # |R - R'| (Frobenius) is 2 sqrt 2 sin(angle / 2); the sine of a small x is above x (1 - x^2 / 6).
        rotation_error = max(rotation_error, math.sqrt(squared_error) / math.sqrt(2) * 1.0001)
        origins = zip(frame["origin"], joint["origin"], strict=True)
        squared_distance = sum((Fraction(x) - Fraction(parse_hex(y))) ** 2 for x, y in origins)
        position_error = max(position_error, math.sqrt(squared_distance) * ROUND_UP)
    return rotation_error, position_error


def structural_zero_schema(document: dict[str, Any], n: int) -> dict[str, Any]:
    """Return the form of the keys that a structural zero has in addition to the common ones."""
    require_revolute(document)
    require(document["task"] == "pose" and n > 2, "a structural zero needs the task pose, and 3 joints or more")
    frame = {"rotation": [INTEGER_PATTERN, 4], "origin": [RATIONAL_PATTERN, 3]}
    return {"locked": range(1, n - 1), "snapped": [frame, n], "points": [RATIONAL_PATTERN, n]}


def describe_structural_zero(document: dict[str, Any], names: list[str]) -> str:
    """Return the claim of a structural zero as a sentence without its end."""
    tolerance = "{} rad and {} m".format(
        *(f"{round_to_two_digits(Fraction(error), True):g}" if error else "0" for error in bound_frame_errors(document))
    )
    text = f"For every configuration of an arm whose frames are within {tolerance} of the file's, "
    return f"{text}relative manipulability of the pose after a lock of {names[document['locked']]} is 0;"
