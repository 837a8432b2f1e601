"""Distances between the spheres that cover an arm and objects with a formula, in blocks that share a compiled program."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.machine import Machine
from holdfast.caching import cached_property
from holdfast.cell.solids import Primitive
from holdfast.clearance.capsules import BASE
from holdfast.clearance.chains import Balls
from holdfast.clearance.object_kernels import BLOCK, NUMBERS, distance_kernel, nearest_kernel
from holdfast.kernels.kernel import Kernel

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

NOWHERE = 1e9  # m: how far away is what is not looked at


class FormulaObjects:
    """Objects with a formula, as an arm meets them.

    Args:
        arm: The arm.
        balls: The spheres that cover it.
        objects: F of them.
        added: (L, F) added to the distance of each moving link from each, m.
        margins: (F,) what is kept from each, m; nothing if not given.
    """

    def __init__(
        self, arm: Machine, balls: Balls, objects: Sequence[Primitive], added: Array, margins: Array | None = None
    ) -> None:
        self.arm, self.balls, self.objects, self._added = arm, balls, list(objects), added
        self._margins = np.zeros(len(self.objects)) if margins is None else margins
        self._links = len(np.unique(balls.link[balls.link > BASE]))

    @cached_property
    def _distance_kernel(self) -> Kernel:
        return distance_kernel(self.arm, self.balls)

    @cached_property
    def _nearest_kernel(self) -> Kernel:
        return nearest_kernel(self.arm, self.balls)

    @cached_property
    def _bare(self) -> Array:
        return self._blocks(np.zeros(len(self.objects)))

    @cached_property
    def _larger(self) -> Array:
        return self._blocks(self._margins)

    def _blocks(self, extra: Array) -> Array:
        """(B, BLOCK, 18 + L) what the kernels take, block by block, every object larger by so much (F,), m."""
        nowhere = np.concatenate([np.zeros(NUMBERS), np.full(self._links, NOWHERE)])  # what is lacking to whole blocks
        numbers = [solid.numbers(more) for solid, more in zip(self.objects, extra.tolist(), strict=True)]
        rows = [np.concatenate(row) for row in zip(numbers, self._added.T, strict=True)]
        rows += [nowhere] * (-len(rows) % BLOCK)
        return np.array(rows).reshape(-1, BLOCK, len(nowhere))

    def _by_block(self, kernel: Kernel, q: Array, blocks: Array, first: int | None = None) -> list[Array]:
        """(N, outputs) of each block."""
        if len(q) == 1:  # one call: the blocks are its rows
            return list(kernel.rows(np.repeat(q, len(blocks), axis=0), blocks, first=first)[:, None])
        return [kernel.rows(q, block, first=first) for block in blocks]

    def _least(self, q: Array, blocks: Array) -> Array:
        if not (self.objects and self._links):
            return np.where(np.isfinite(q).all(axis=1), np.inf, np.nan)
        return reduce(np.minimum, [rows[:, 0] for rows in self._by_block(self._distance_kernel, q, blocks, first=1)])

    def least(self, q: Array) -> Array:
        """(N,) the least distance, m; infinite without an object, NaN for rows (N, n) that are not finite."""
        return self._least(q, self._bare)

    def room(self, q: Array) -> Array:
        """(N,) the least distance beyond the margins, m."""
        return self._least(q, self._larger)

    def distances(self, q: Array) -> Array:
        """(N, L, F) lower bound of the distance of every link from every object, m."""
        rows = [x[:, 1:].reshape(len(q), self._links, BLOCK) for x in self._by_block(self._distance_kernel, q, self._bare)]
        return np.concatenate([np.empty((len(q), self._links, 0)), *rows], axis=2)[:, :, : len(self.objects)]

    def nearest(self, q: Array) -> tuple[Array, Indices, Indices, Array]:
        """Least distance beyond the margins, m; position of its link, its object, and the gradient (N, n).

        Args:
            q: (N, n) rad and m; a row that is not finite gets NaN.
        """
        rows = np.stack(self._by_block(self._nearest_kernel, q, self._larger))
        block = np.argmin(rows[:, :, 0], axis=0)  # NaN is in all of them or in none
        best = rows[block, np.arange(len(q))]
        link, thing = np.nan_to_num(best[:, 1]).astype(np.int64), np.nan_to_num(best[:, 2]).astype(np.int64)
        # Where all may touch, an object that is not there may be the first.
        return best[:, 0], link, np.minimum(block * BLOCK + thing, len(self.objects) - 1), best[:, 3:]
