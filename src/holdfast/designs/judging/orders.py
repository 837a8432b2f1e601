"""The same lines in another order: alike at one configuration, and different arms everywhere else."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import combinations, permutations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.arguments import checked, real_numbers
from holdfast.designs.synthesis.axes import axes_of
from holdfast.errors import InputError
from holdfast.failures.sets import FailureSets
from holdfast.kernels.kernel import Kernel
from holdfast.linalg import householder, smallest, squared_volume
from holdfast.probability.intervals import Interval
from holdfast.result import Result
from holdfast.words import percent

Array = NDArray[np.float64]

_MOST = 2520  # orders: all of seven joints
_FRESH = 10  # times as many samples for the front
_DIGITS = 9  # of the invariants of lines
_PARALLEL = 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class Orders(Result):
    """How much each order of the columns of a pose Jacobian keeps over its whole joint space.

    Attributes:
        orders: (D, n) columns, from 0; of an order and its reverse, which is the same arm read from the tool, one, and one of
            those that a symmetry of the lines makes the same.
        thresholds: Values of relative manipulability.
        counts: (D, T) configurations at or above each threshold.
        mean: (D,) of relative manipulability.
        lengths: (D,) sums of the distances between axes that follow one another, m: a long arm is no better.
        front: Orders, numbers from 0, that no other beats in both the fraction at the last but one threshold and the length, by
            length; chosen on the samples of the search, and again, of those, on fresh ones.
        fresh: (F,) that fraction of each of them on the fresh samples, ten times as many.
        at_home: What all of them have at the configuration of zeros.
        samples: Configurations of each order, full circles, drawn evenly: the same for all.
        seed: Of the draws.
    """

    orders: NDArray[np.int64]
    thresholds: tuple[float, ...]
    counts: NDArray[np.int64]
    mean: Array
    lengths: Array
    front: NDArray[np.int64]
    fresh: Array
    at_home: float
    samples: int
    seed: int

    @property
    def fractions(self) -> Array:
        """(D, T) of the joint space."""
        return np.asarray(self.counts / self.samples)

    def interval(self, order: int, threshold: int) -> Interval:
        """The fraction of one order above one threshold, with its exact 95 % interval."""
        return Interval.of(int(self.counts[order, threshold]), self.samples)

    def describe(self) -> list[str]:
        """The best and the worst order at each threshold, beside what all have at one configuration."""
        lines = [f"{len(self.orders)} orders of the same lines, {self.at_home:.4f} at home in all"]
        for t, h in enumerate(self.thresholds):
            best, worst = int(self.counts[:, t].argmax()), int(self.counts[:, t].argmin())
            named = " ".join(str(k + 1) for k in self.orders[best])
            share = self.fractions
            lines.append(
                f"at least {h:g}: {percent(share[best, t])} of the configurations in the best order ({named}), "
                f"{percent(share[worst, t])} in the worst"
            )
        some = [f"{percent(x)} with {self.lengths[d]:.3g} m" for d, x in zip(self.front, self.fresh, strict=True)]
        lines.append(f"at least {self.thresholds[-2]:g} against length, on fresh samples: {', '.join(some)} between the axes")
        return lines


@checked
def judge_orders(
    jacobian: ArrayLike,
    *,
    failures: int = 1,
    thresholds: tuple[float, ...] = (0.05, 0.1, 0.2, 0.3),
    samples: int = 2000,
    at_most: int | None = None,
    seed: int = 0,
) -> Orders:
    """Judge the arms of all orders of the columns of a pose Jacobian over their whole joint spaces.

    Args:
        jacobian: (6, n) of revolute joints, v above w.
        failures: Joints that lock at once.
        thresholds: Values of relative manipulability.
        samples: Configurations of each order; 400 rank wrongly, 20,000 rank well.
        at_most: So many orders, drawn at random, where there are more.
        seed: Of the draws.

    Raises:
        InputError: More than 2,520 orders (of more than seven joints) without ``at_most``; columns that are not lines; fewer
            than two thresholds.

    Source: derived here.
    """
    given = real_numbers(jacobian, "the Jacobian")
    if given.ndim != 2 or len(given) != 6:
        raise InputError(f"the Jacobian has shape {given.shape}; orders are judged for poses, of 6 rows")
    w, o = axes_of(given)
    n, rng = len(w), np.random.default_rng(seed)
    if len(thresholds) < 2:
        raise InputError("give two thresholds or more; the front is that of the last but one")
    if at_most is None and n > 7:
        raise InputError(f"{n} joints have more than {_MOST} orders; say how many with at_most")
    if n <= 7:
        orders = distinct_orders(w, o)
        orders = orders if at_most is None or at_most >= len(orders) else rng.permutation(orders)[:at_most]
    else:
        orders = np.array([rng.permutation(n) for _ in range(int(at_most or 0))])
    kernel, lines = _worst(n, failures), np.hstack([w, o])

    def values(order: NDArray[np.int64], q: Array) -> Array:
        return np.sqrt(np.maximum(np.nan_to_num(kernel.rows(lines[order].ravel(), q)[:, 0]), 0.0))

    q = rng.uniform(-np.pi, np.pi, (samples, n))
    counts, mean = np.zeros((len(orders), len(thresholds)), dtype=np.int64), np.zeros(len(orders))
    for d, order in enumerate(orders):
        value = values(order, q)
        counts[d], mean[d] = [(value >= h).sum() for h in thresholds], value.mean()
    lengths = _between(w, o)[orders[:, :-1], orders[:, 1:]].sum(axis=1)
    first = _front(lengths, counts[:, -2].astype(float))
    q = rng.uniform(-np.pi, np.pi, (_FRESH * samples, n))
    fresh = np.array([(values(orders[d], q) >= thresholds[-2]).mean() for d in first])
    kept = _front(lengths[first], fresh)
    home = float(np.sqrt(kernel.rows(lines.ravel(), np.zeros((1, n)))[0, 0]))
    return Orders(
        orders=orders,
        thresholds=thresholds,
        counts=counts,
        mean=mean,
        lengths=lengths,
        front=first[kept],
        fresh=fresh[kept],
        at_home=home,
        samples=samples,
        seed=seed,
    )


def distinct_orders(w: Array, o: Array) -> NDArray[np.int64]:
    """Orders (D, n) of lines that make different arms: of an order and its reverse one, and one of those alike by a symmetry.

    Lines are alike if what does not depend on frames and on the senses of the axes is: for every two, and as a product for
    every three of them, cosine and mutual moment of the axes, and their distance.

    Args:
        w: (n, 3) unit directions.
        o: (n, 3) points, m.

    Source: derived here.
    """
    n = len(w)
    orders = np.array([x for x in permutations(range(n)) if x[0] < x[-1]])
    v = np.cross(o, w)
    between = _between(w, o)
    tables = [w @ w.T, w @ v.T + v @ w.T]
    pairs, triples = (np.array(list(combinations(range(n), size))).reshape(-1, size) for size in (2, 3))

    def invariants(some: NDArray[np.int64]) -> Array:
        a, b = some[:, pairs].transpose(2, 0, 1)
        c, d, e = some[:, triples].transpose(2, 0, 1)
        found = [abs(t[a, b]) for t in (*tables, between)] + [t[c, d] * t[d, e] * t[e, c] for t in tables]
        return np.round(np.concatenate([*found, tables[0][c, d] * tables[1][d, e] * tables[1][e, c]], axis=1), _DIGITS) + 0.0

    forward, back = invariants(orders), invariants(orders[:, ::-1])
    apart = forward != back
    place = apart.argmax(axis=1)[:, None]
    later = np.take_along_axis(forward, place, 1) > np.take_along_axis(back, place, 1)
    _, first = np.unique(np.where(later, back, forward), axis=0, return_index=True)
    return np.asarray(orders[np.sort(first)], dtype=np.int64)


def _between(w: Array, o: Array) -> Array:
    """Distances (n, n) of lines, m."""
    normal = np.cross(w[:, None], w[None])
    size = np.linalg.norm(normal, axis=2)
    apart = o[None] - o[:, None]
    skew = abs((apart * normal).sum(axis=2)) / np.maximum(size, 1e-300)
    along = np.linalg.norm(np.cross(apart, w[:, None]), axis=2)
    return np.asarray(np.where(size < _PARALLEL, along, skew))


def _front(lengths: Array, fractions: Array) -> NDArray[np.int64]:
    """Numbers of what nothing is both shorter and better than, by length."""
    order = np.lexsort((-fractions, lengths))
    best = np.maximum.accumulate(np.concatenate([[-np.inf], fractions[order][:-1]]))
    return np.asarray(order[fractions[order] > best], dtype=np.int64)


@cache
def _worst(n: int, failures: int) -> Kernel:
    """Least squared relative manipulability of a pose from lines (6 n) and q (n): one program serves all orders."""
    lines, q = ca.SX.sym("lines", 6 * n), ca.SX.sym("q", n)
    turn, shift, columns = ca.SX.eye(3), ca.SX.zeros(3), []
    for i in range(n):
        axis, point = lines[6 * i : 6 * i + 3], lines[6 * i + 3 : 6 * i + 6]
        w, at = turn @ axis, turn @ point + shift
        columns.append(ca.vertcat(ca.cross(at, w), w))
        if i == 0:
            continue  # turning all lines together changes nothing
        cross = ca.skew(axis)
        rotation = ca.SX.eye(3) + ca.sin(q[i]) * cross + (1 - ca.cos(q[i])) * cross @ cross
        shift = turn @ (point - rotation @ point) + shift
        turn = turn @ rotation
    rows = householder(ca.horzcat(*columns)).null_rows()
    sets: FailureSets = tuple(combinations(range(n), failures))
    return Kernel(f"worst order {n} {failures}", [lines, q], [smallest([squared_volume([rows[k] for k in s]) for s in sets])])
