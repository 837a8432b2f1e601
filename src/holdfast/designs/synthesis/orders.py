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


@dataclass(frozen=True, kw_only=True, eq=False)
class Orders(Result):
    """How much each order of the columns of a pose Jacobian keeps over its whole joint space.

    Attributes:
        orders: (D, n) columns, from 0; of an order and its reverse, which is the same arm read from the tool, one.
        thresholds: Values of relative manipulability.
        counts: (D, T) configurations at or above each threshold.
        mean: (D,) of relative manipulability.
        at_home: What all of them have at the configuration of zeros.
        samples: Configurations of each order, full circles, drawn evenly: the same for all.
        seed: Of the draws.
    """

    orders: NDArray[np.int64]
    thresholds: tuple[float, ...]
    counts: NDArray[np.int64]
    mean: Array
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
        InputError: More than 2,520 orders (of more than seven joints) without ``at_most``; columns that are not lines.

    Source: derived here.
    """
    given = real_numbers(jacobian, "the Jacobian")
    if given.ndim != 2 or len(given) != 6:
        raise InputError(f"the Jacobian has shape {given.shape}; orders are judged for poses, of 6 rows")
    w, o = axes_of(given)
    n, rng = len(w), np.random.default_rng(seed)
    if at_most is None and n > 7:
        raise InputError(f"{n} joints have more than {_MOST} orders; say how many with at_most")
    if n <= 7:
        orders = np.array([x for x in permutations(range(n)) if x[0] < x[-1]])
        orders = orders if at_most is None or at_most >= len(orders) else rng.permutation(orders)[:at_most]
    else:
        orders = np.array([rng.permutation(n) for _ in range(int(at_most or 0))])
    kernel, lines = _worst(n, failures), np.hstack([w, o])
    q = rng.uniform(-np.pi, np.pi, (samples, n))
    counts, mean = np.zeros((len(orders), len(thresholds)), dtype=np.int64), np.zeros(len(orders))
    for d, order in enumerate(orders):
        value = np.sqrt(np.maximum(np.nan_to_num(kernel.rows(lines[order].ravel(), q)[:, 0]), 0.0))
        counts[d], mean[d] = [(value >= h).sum() for h in thresholds], value.mean()
    home = float(np.sqrt(kernel.rows(lines.ravel(), np.zeros((1, n)))[0, 0]))
    return Orders(orders=orders, thresholds=thresholds, counts=counts, mean=mean, at_home=home, samples=samples, seed=seed)


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
