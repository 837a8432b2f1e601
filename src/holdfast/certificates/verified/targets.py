"""The leaves of a reach: for every target and locked value of each, some configuration near its centre reaches.

Around the centre the rows g of the task's error are expanded: exact first and second derivatives, and a bound for the third.
With a section variable s this bounds |g - s| by e(S) over the leaf and a box of half widths S. Where e(S) <= S, the map
s -> s - g sends that box into itself, so by Brouwer's theorem some s has g = 0. Any matrix D may span the section; it decides
whether e(S) <= S.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from .balls import LEAST, UP, Balls, flint, times
from .boxes import Boxes
from .chain import Array, exactly, turned
from .forms import UNIT, real
from .rows import MOST_TURNED, STRAIGHT, Rows
from .tree import Cell


class Leaves(Boxes):
    """The leaves of one reach claim and their proofs."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._given = document | {"tree": "", "centres": ""}
        self.rows, self.locked = Rows(document), document["locked"]
        ends = [*document["target"]["box"], *([document["angle"]] if self.locked >= 0 else [])]
        super().__init__(document["arm"], ends, document["task"] == "planar-pose")
        self.m, self.p, self.own = self.rows.m, len(document["target"]["axes"]), self.lengths(0, self.n)
        self.limits = np.array([[real(x) for x in pair] for pair in document["limits"]])
        self.still = [k for k, (low, high) in enumerate(self.limits) if low == high and k != self.locked]
        self.free = [k for k in range(self.n) if k != self.locked and k not in self.still]

    def __reduce__(self) -> tuple[Any, ...]:  # to another process, whose balls are its own
        return Leaves, (self._given,)

    def placed(self, chunk: list[tuple[Cell, Any]]) -> tuple[list[Array], list[Array]]:
        """The joints at the centres, and the axes of the cells, as :func:`turned` gives them."""
        axes = [self.middles(a, [cell for cell, _ in chunk]) for a in range(len(self.width))]
        joints = np.array([exactly(values) for values in (np.array([counts for _, counts in chunk]) * UNIT).T])
        for k in self.still:
            joints[k] = turned(Fraction(self.limits[k, 0]))
        if self.locked >= 0:
            joints[self.locked] = axes[-1]
        return list(joints), axes

    def section(self, slopes: Array) -> Array:
        """Any matrices D (leaves, joints and turns, axes of the cell and of the section); these follow the solution."""
        p, fixed, linear = self.p, self.locked >= 0, self.rows.linear
        inverse = np.linalg.pinv(np.nan_to_num(slopes[:, :, self.free]))
        made = np.zeros((len(slopes), slopes.shape[2], p + fixed + self.m))
        made[:, self.free, :linear], made[:, self.free, p + fixed :] = inverse[:, :, :linear], inverse
        follow = {axis: self.n + axis - linear for axis in range(linear, p)} | ({p: self.locked} if fixed else {})
        for axis, variable in follow.items():
            made[:, variable, axis] = 1
            made[:, self.free, axis] = -np.einsum("lfm,lm->lf", inverse, slopes[:, :, variable])
        return np.nan_to_num(made)

    def bounds(self, error: Balls, slopes: Balls, second: Balls, section: Array) -> dict[str, Array]:
        """Above what counts of the form: error and its negative, what is left of the slopes, and second derivatives."""
        d, last, linear = Balls(section), section.shape[2] - self.m, self.rows.linear
        ones = np.zeros((self.m, section.shape[2]))
        ones[:, last:], ones[:linear, :linear] = -np.eye(self.m), -np.eye(linear)
        left = times("nak,nkc->nac", slopes, d) + Balls(ones)
        twice = times("nki,nakj->naij", d, times("nakl,nlj->nakj", second, d))
        own = np.diagonal(twice.at, axis1=2, axis2=3), np.diagonal(twice.off, axis1=2, axis2=3)
        return {
            "over": np.nextafter(error.at + error.off, np.inf), "under": np.nextafter(error.off - error.at, np.inf),
            "slope": left.size, "mixed": np.triu(twice.size, 1), "up": np.maximum(own[0] + own[1], 0) * UP,
            "down": np.maximum(own[1] - own[0], 0) * UP, "reach": np.abs(section),
        }  # fmt: skip

    def excess(self, bounds: dict[str, Array], q: Array, w: Array) -> tuple[Array, Array, Array]:
        """e(S) for half widths of cells and sections, how far joints go, and the angles that they turn by; all rounded up."""
        far = np.einsum("nkc,nc->nk", bounds["reach"], w) * UP
        third, angle = self.third(far[:, : self.n], self.own, q)
        angle = (angle + far[:, self.n :].sum(axis=1)) * UP
        rest = np.stack([third] * self.rows.linear + [angle**3 / 6] * (self.m - self.rows.linear), axis=1)
        rest += np.einsum("nac,nc->na", bounds["slope"], w) + np.einsum("nacd,nc,nd->na", bounds["mixed"], w, w)
        high, low = ((rest + np.einsum("nac,nc->na", bounds[key], w**2) / 2) * UP for key in ("up", "down"))
        return np.nextafter(np.maximum(bounds["over"] + high, bounds["under"] + low), np.inf) + LEAST, far, angle

    def rejected(self, chunk: list[tuple[Cell, Any]]) -> tuple[int, list[Cell]]:
        """How many leaves were checked, and those where not every target and locked value is proved to have a configuration."""
        with flint.ctx.workprec(64), np.errstate(all="ignore"):
            joints, axes = self.placed(chunk)
            error, slopes, second = self.rows.error(self.moved(joints), axes[: self.p])
            straight = error.low[:, -1] > STRAIGHT if self.rows.rotated else True
            rows = slice(self.m)
            section = self.section(slopes.at[:, rows])
            bounds = self.bounds(error[:, rows], slopes[:, rows], second[:, rows], section)
            widths, q = np.stack([axis[:, 2] for axis in axes], 1), np.stack([joint[:, 0] for joint in joints], 1)
            s = np.zeros((len(chunk), self.m))
            # 30 times wider until e(S) <= S; then 8 times narrower: as e grows with S, e(S) is such a box again.
            for i in range(39):
                e, far, angle = self.excess(bounds, q, np.concatenate([widths, s], axis=1))
                closed = np.asarray(((e <= s) & (s < 1e3)).all(axis=1))
                s = np.where(closed[:, None], s if i < 30 or i == 38 else e, 1.05 * e + 1e-9)
        low, high = np.nextafter(q - far[:, : self.n], -np.inf), np.nextafter(q + far[:, : self.n], np.inf)
        inside = ((low >= self.limits[:, 0]) & (high <= self.limits[:, 1]))[:, self.free].all(axis=1)
        good = closed & inside & straight & ((angle < MOST_TURNED) | (not self.rows.rotated))
        return len(chunk), [cell for (cell, _), fine in zip(chunk, good, strict=True) if not fine]
