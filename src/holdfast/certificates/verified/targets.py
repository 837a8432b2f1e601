"""The leaves of a reach: for every target and locked value of each, some configuration near its centre reaches.

Joints follow the place in a leaf along any matrix, here the one by which the tool follows the target to first order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from .balls import Array, Balls, Flags
from .chain import Boxes, Chain, Leaf, exactly, gantry, turned
from .forms import TASKS, need, real, unpacked
from .taylor import Error, Inclusion
from .tree import MOST_LEAVES, PROVED, Cell, cells

UNIT = 2.0**-24  # rad or m, of centres


class Targets(Boxes):
    """Boxes whose last axes are those of a target and the arm that is to be there."""

    def __init__(self, document: dict[str, Any], before: list[Any], after: list[Any], flat: bool) -> None:
        super().__init__(document, [*before, *document["target"]["box"], *after])
        self.task, self.locked, self.arm = document["task"], document["locked"], Chain(document["arm"], flat)
        self.goal, self.n, self.p = Chain(gantry(document["target"])), self.arm.n, len(document["target"]["axes"])
        self.limits = np.array([[real(x) for x in pair] for pair in document["limits"]])
        linear = TASKS[self.task][0]
        self.targets, self.turning = slice(len(before), len(before) + self.p), self.p - linear
        self.places = [*range(linear)][::-1] + [*range(linear, self.p)][::-1]  # axes of a target, as its chain has them
        self.variables = [*range(linear, self.p), *range(linear)]  # and as an error has them, behind the arm's joints

    def error(self, joints: list[Array], target: list[Array]) -> Error:
        """The rows of the task."""
        return Error(self.task, self.arm, joints, self.goal, [target[axis] for axis in self.places])


class Leaves(Targets):
    """The leaves of one reach claim and their proofs: the joints at their centres, in units."""

    def __init__(self, document: dict[str, Any]) -> None:
        locked = document["locked"]
        super().__init__(document, [], [document["angle"]] if locked >= 0 else [], document["task"] == "planar-pose")
        self.still = [k for k, (low, high) in enumerate(self.limits) if low == high and k != locked]
        self.free = [k for k in range(self.n) if k != locked and k not in self.still]

    def leaves(self, document: dict[str, Any]) -> tuple[int, list[Cell], Callable[[], Iterator[Leaf]]]:
        """How many there are, which cells are undecided, and the leaves."""
        tree, axes = unpacked(document["tree"], 2 * MOST_LEAVES - 1, "tree"), len(self.width)
        undecided = [cell for token, cell in cells(tree, axes) if token != PROVED]
        count, row = tree.count(PROVED), 4 * self.n
        packed = unpacked(document["centres"], row * count, "centres")
        need(len(packed) == row * count, "there are fewer centres than leaves")
        centres = np.frombuffer(packed, "<i4").reshape(count, self.n)
        need(not np.delete(centres, self.free, axis=1).any(), "centres of joints that do not move must be 0")
        return count, undecided, lambda: zip((x for token, x in cells(tree, axes) if token == PROVED), centres, strict=True)

    def placed(self, leaves: list[Leaf]) -> tuple[list[Array], list[Array]]:
        """The joints at the centres, and the axes of the cells, as :func:`turned` gives them."""
        axes = self.middles(cell for cell, _ in leaves)
        joints = [exactly(values) for values in (np.array([counts for _, counts in leaves]) * UNIT).T]
        for k in self.still:
            joints[k] = np.array([turned(Fraction(self.limits[k, 0]))] * len(leaves))
        if self.locked >= 0:
            joints[self.locked] = axes[-1]
        return joints, axes

    def section(self, error: Error) -> Array:
        """Any matrices D (N, V, axes of the cell and of the section); these follow the solution."""
        slopes, axes = error.slopes.at[:, : error.m], len(self.width)
        inverse = np.linalg.pinv(np.nan_to_num(slopes[:, :, self.free]))
        made = np.zeros((len(slopes), slopes.shape[2], axes + error.m))
        made[:, self.free, axes:] = inverse
        for axis, variable in enumerate([*np.argsort(self.variables) + self.n, *[self.locked] * (axes - self.p)]):
            made[:, variable, axis] = 1
            made[:, self.free, axis] = -np.einsum("nfm,nm->nf", inverse, slopes[:, :, variable])
        return np.nan_to_num(made)

    def included(self, leaves: list[Leaf]) -> tuple[Inclusion, Balls]:
        """The leaves with their sections, and the middles (N, n)."""
        joints, axes = self.placed(leaves)
        error, q = self.error(joints, axes), np.stack([joint[:, :2] for joint in joints], 2)
        w = np.stack([*(axis[:, 2] for axis in axes), *[np.zeros(len(leaves))] * error.m], 1)
        return Inclusion(error, Balls(self.section(error)), np.zeros((error.m, w.shape[1])), w), Balls(q[:, 0], q[:, 1])

    def kind(self, leaf: Leaf) -> int:
        """All are of one."""
        return 0

    def proves(self, kind: int, leaves: list[Leaf]) -> Flags:
        """Whether every target and locked value has a configuration."""
        found, q = self.included(leaves)
        return found.good & found.within(q, self.limits, self.free)
