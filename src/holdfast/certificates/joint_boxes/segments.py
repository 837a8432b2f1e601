"""How near and how far a point of a link may be from a target over boxes of joints and targets: in doubles, for batches.

Along any direction e the distance is at least e.(y - x), whose first and second derivatives at the centre of a box are exact
and whose third is bounded by the lengths that joints carry. The greatest distance is bounded through half its square.
Everything here may be wrong: the verifier decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from holdfast.certificates.taylor import Chain

Array = NDArray[np.float64]
_ON_AXIS = 1e-9  # m, of a point from an axis that it lies on


@dataclass(frozen=True, eq=False)
class Segment:
    """Some successive joints of a chain, from a link to a point of a later one.

    Attributes:
        first, last: The joints are first to last - 1; coordinates are those of link ``first``, which joint first - 1 moves.
        rotations: (k, 3, 3) of each joint's frame in the one before.
        origins: (k, 3) likewise, m.
        end: (3,) m, the point in the last of these frames.
        lengths: (k,) m, of what joint k and those before it turn and the next one does not; of a slide without its value.
        slides: (k,) which of them slide.
    """

    first: int
    last: int
    rotations: Array
    origins: Array
    end: Array
    lengths: Array
    slides: NDArray[np.bool_]

    @classmethod
    def of(cls, chain: Chain, first: int, last: int, end: Array) -> Segment:
        """The joints first to last - 1 of a chain."""
        turns, links = chain.rotations[first:last], [*chain.origins[first + 1 : last], end]
        lengths, slides = [], chain.slides[first:last]
        for k, link in enumerate(links[: last - first]):
            across = link * [1, 1, slides[k]]
            if k + 1 < len(links) and not slides[k + 1]:
                across = across + turns[k + 1] @ [0, 0, links[k + 1][2]]
            lengths.append(float(np.linalg.norm(across)))
        return cls(first, last, turns, chain.origins[first:last], np.asarray(end), np.array(lengths), slides)

    def frames(self, q: Array) -> tuple[Array, Array, Array]:
        """The point (N, 3), axes of what turns (N, k, 3), 0 of slides, and derivatives of the point (N, k, 3) at q (N, k)."""
        tip, axes, places = self.placed(q)
        turning = np.cross(axes, tip[:, None] - places)
        return tip, axes * ~self.slides[:, None], np.where(self.slides[:, None], axes, turning)

    def placed(self, q: Array) -> tuple[Array, Array, Array]:
        """The point (N, 3), axes (N, k, 3) and origins of the joints on these (N, k, 3) at q (N, k)."""
        count, joints = q.shape
        turn, tip = np.broadcast_to(np.eye(3), (count, 3, 3)), np.zeros((count, 3))
        axes, places = np.zeros((count, joints, 3)), np.zeros((count, joints, 3))
        cosines, sines = np.cos(q), np.sin(q)
        for k in range(joints):
            tip = tip + turn @ self.origins[k]
            turn = turn @ self.rotations[k]
            axes[:, k], places[:, k] = turn[:, :, 2], tip
            if self.slides[k]:
                tip = tip + axes[:, k] * q[:, k, None]
                continue
            x, y = turn[:, :, 0], turn[:, :, 1]
            c, s = cosines[:, k, None], sines[:, k, None]
            turn = np.stack([c * x + s * y, c * y - s * x, turn[:, :, 2]], axis=2)
        tip = tip + turn @ self.end
        return tip, axes, places

    def on_axes(self, point: Array) -> int:
        """How many of the first joints turn about axes through a point (3,): they do not change its distance."""
        turn, place = np.eye(3), np.zeros(3)
        for k in range(len(self.lengths)):
            place = place + turn @ self.origins[k]
            turn = turn @ self.rotations[k]
            if self.slides[k] or np.linalg.norm(np.cross(turn[:, 2], point - place)) > _ON_AXIS:
                return k
        return len(self.lengths)

    def _carried(self, q: Array, half: Array) -> tuple[Array, Array]:
        """Bounds of three derivatives of the point by what joints move (3, N), and what each joint adds to the third (N, k)."""
        c, slid = np.cumsum(half * ~self.slides, axis=1), half * self.slides
        most = self.lengths + np.abs(q) * self.slides + slid
        orders = np.array([(c**k * most + k * c ** (k - 1) * slid).sum(axis=1) for k in (1, 2, 3)])
        return orders, np.where(self.slides, c**3 + 3 * c**2, _later(3 * c**2 * most + 6 * c * slid)) * half

    def nearest(self, q: Array, half: Array, x: Array, wide: Array) -> tuple[Array, Array, Array]:
        """A distance that the point keeps from targets x +- wide (N, 3) over q +- half (N, k).

        Returns:
            The distance (N,), that of the middles less than it may be, and what of it each joint and target coordinate costs
            (N, k + 3).
        """
        tip, axes, columns = self.frames(q)
        v = tip - x
        d = np.maximum(np.linalg.norm(v, axis=1), 1e-300)
        carried, later = self._carried(q, half)
        third = carried[2] / 6
        swept = columns * half[:, :, None]
        spread = np.einsum("nka,nkb->nab", swept, swept)
        spread[:, range(3), range(3)] += wide**2 + 1e-6 * d[:, None] ** 2
        fisher = np.linalg.solve(spread, v[:, :, None])[:, :, 0]
        best: tuple[Array, Array, Array] | None = None
        for e in (v / d[:, None], fisher / np.maximum(np.linalg.norm(fisher, axis=1), 1e-300)[:, None]):
            slope = np.abs(np.einsum("na,nka->nk", e, columns))
            second = np.einsum("nja,nka->njk", np.cross(e[:, None], axes), columns)
            cost, mixed = costs(slope, second, half)
            aside = np.abs(e) * wide
            gap = np.einsum("na,na->n", e, v)
            bound = gap - cost.sum(axis=1) - mixed.sum(axis=1) / 2 - third - aside.sum(axis=1)
            each = np.concatenate([cost + mixed + later / 6, aside], axis=1)
            if best is None:
                best = bound, gap, each
            else:
                better = bound > best[0]
                best = (
                    np.where(better, bound, best[0]),
                    np.where(better, gap, best[1]),
                    np.where(better[:, None], each, best[2]),
                )
        assert best is not None
        return best

    def farthest(self, q: Array, half: Array, x: Array, wide: Array) -> tuple[Array, Array, Array]:
        """A distance that the point keeps within, as :meth:`nearest`: the bound, that of the middles, what each costs."""
        tip, axes, columns = self.frames(q)
        count, joints = q.shape
        v = tip - x
        d = np.linalg.norm(v, axis=1)
        (v1, v2, v3), later = self._carried(q, half)
        v1 = v1 + np.linalg.norm(wide, axis=1)
        third = (3 * v1 * v2 + (d + v1) * v3) / 6
        width = np.concatenate([half, wide], axis=1)
        whole = np.concatenate([columns, np.broadcast_to(-np.eye(3), (count, 3, 3))], axis=1)
        second = np.einsum("nja,nka->njk", whole, whole)
        second[:, :joints, :joints] += np.einsum("nja,nka->njk", np.cross(v[:, None], axes), columns)
        cost, mixed = costs(np.abs(np.einsum("na,nka->nk", v, whole)), -second, width)
        bound = d**2 / 2 + cost.sum(axis=1) + mixed.sum(axis=1) / 2 + third
        each = cost + mixed
        each[:, :joints] += (d + v1)[:, None] * later / 6
        return np.sqrt(2 * bound), d, each


def points_on_axes(chain: Chain, joints: Array, rng: np.random.Generator) -> list[tuple[int, Array]]:
    """Links and points of theirs, each the point of the next axis that is nearest to the one behind it: (link, (3,)).

    Where the next joint slides there is none: it takes every point of its axis elsewhere.
    """
    n, made = len(chain.lengths), list[tuple[int, Array]]()
    q, before = rng.uniform(joints[:, 0], joints[:, 1], (8, n)), np.full((8, 3), np.inf)
    for k in np.flatnonzero(~chain.slides).tolist():
        near = chain.nearest(k) if k + 1 < n else None  # of parallel axes, and the last one, the height of what comes next
        point = chain.origins[k] + chain.rotations[k][:, 2] * (near[0] if near else chain.origins[k + 1][2])
        at = Segment.of(chain, 0, k, point).frames(q[:, :k])[0]
        if np.abs(at - before).max() > 1e-6:
            made.append((k, point))
        before = at
    return made


def costs(slope: Array, second: Array, half: Array) -> tuple[Array, Array]:
    """Of each variable what slope and own curvature cost (N, k), and its part in all pairs (N, k): half of them is the sum.

    Args:
        slope: (N, k), not negative.
        second: (N, k, k) second derivatives, of which those for j <= k count.
        half: (N, k).
    """
    own = np.diagonal(second, axis1=1, axis2=2)
    with np.errstate(divide="ignore", invalid="ignore"):
        bent = np.where(slope < own * half, slope**2 / (2 * own), slope * half - own * half**2 / 2)
    upper = np.triu(np.abs(second), 1) * half[:, :, None] * half[:, None]
    return bent, upper.sum(axis=1) + upper.sum(axis=2)


def _later(x: Array) -> Array:
    """Of each column the sum of it and those behind."""
    return np.asarray(np.cumsum(x[:, ::-1], axis=1)[:, ::-1])
