"""Compare arms made of the same joint axes in different orders, which agree at one configuration and differ elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import combinations, permutations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.core.errors import InputError
from holdfast.core.formatting import format_percent
from holdfast.core.probability.intervals import Interval
from holdfast.core.typing import FloatArray
from holdfast.core.validation import check_arguments, require_real_numbers
from holdfast.kernels.kernel import Kernel
from holdfast.kernels.linalg import factor_householder, gram_determinant, select_smallest
from holdfast.model.failure_modes.sets import FailureSets
from measurements.synthesis.axes import find_joint_axes

_MAX_ORDERS = 2520  # orders: all of seven joints
_CHECK_SAMPLE_FACTOR = 10  # times as many samples for the front
_INVARIANT_DECIMALS = 9  # of the invariants of lines
_PARALLEL_SINE = 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class JointOrders:
    """Performance of each order of the columns of a pose Jacobian over its whole joint space.

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
    mean: FloatArray
    lengths: FloatArray
    front: NDArray[np.int64]
    fresh: FloatArray
    at_home: float
    samples: int
    seed: int

    @property
    def fractions(self) -> FloatArray:
        """(D, T) fraction of the joint space at or above each threshold."""
        return np.asarray(self.counts / self.samples)

    def interval(self, order: int, threshold: int) -> Interval:
        """Return the fraction of one order above one threshold, with its 95 % Clopper-Pearson interval."""
        return Interval.from_counts(int(self.counts[order, threshold]), self.samples)

    def describe(self) -> list[str]:
        """Return the best and the worst order at each threshold, and the common value at one configuration."""
        lines = [f"{len(self.orders)} orders of the same lines, {self.at_home:.4f} at home in all"]
        for column, threshold in enumerate(self.thresholds):
            best, worst = int(self.counts[:, column].argmax()), int(self.counts[:, column].argmin())
            order_text = " ".join(str(k + 1) for k in self.orders[best])
            fractions = self.fractions
            lines.append(
                f"at least {threshold:g}: {format_percent(fractions[best, column])} of the configurations in the best "
                f"order ({order_text}), "
                f"{format_percent(fractions[worst, column])} in the worst"
            )
        front_texts = [
            f"{format_percent(fraction)} with {self.lengths[order]:.3g} m"
            for order, fraction in zip(self.front, self.fresh, strict=True)
        ]
        lines.append(
            f"at least {self.thresholds[-2]:g} against length, on fresh samples: {', '.join(front_texts)} between the axes"
        )
        return lines


@check_arguments
def compare_joint_orders(
    jacobian: ArrayLike,
    *,
    failures: int = 1,
    thresholds: tuple[float, ...] = (0.05, 0.1, 0.2, 0.3),
    samples: int = 2000,
    at_most: int | None = None,
    seed: int = 0,
) -> JointOrders:
    """Compare the arms of all orders of the columns of a pose Jacobian over their whole joint spaces.

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
    columns = require_real_numbers(jacobian, "the Jacobian")
    if columns.ndim != 2 or len(columns) != 6:
        raise InputError(f"the Jacobian has shape {columns.shape}; orders are judged for poses, of 6 rows")
    directions, origins = find_joint_axes(columns)
    n, rng = len(directions), np.random.default_rng(seed)
    if len(thresholds) < 2:
        raise InputError("give two thresholds or more; the front is that of the last but one")
    if at_most is None and n > 7:
        raise InputError(f"{n} joints have more than {_MAX_ORDERS} orders; say how many with at_most")
    if n <= 7:
        orders = find_distinct_orders(directions, origins)
        orders = orders if at_most is None or at_most >= len(orders) else rng.permutation(orders)[:at_most]
    else:
        orders = np.array([rng.permutation(n) for _ in range(int(at_most or 0))])
    kernel, lines = _make_worst_case_kernel(n, failures), np.hstack([directions, origins])

    def manipulabilities(order: NDArray[np.int64], q: FloatArray) -> FloatArray:
        return np.sqrt(np.maximum(np.nan_to_num(kernel.rows(lines[order].ravel(), q)[:, 0]), 0.0))

    q = rng.uniform(-np.pi, np.pi, (samples, n))
    counts, mean = np.zeros((len(orders), len(thresholds)), dtype=np.int64), np.zeros(len(orders))
    for number, order in enumerate(orders):
        value = manipulabilities(order, q)
        counts[number], mean[number] = [(value >= threshold).sum() for threshold in thresholds], value.mean()
    lengths = _compute_line_distances(directions, origins)[orders[:, :-1], orders[:, 1:]].sum(axis=1)
    front_orders = _find_front(lengths, counts[:, -2].astype(float))
    q = rng.uniform(-np.pi, np.pi, (_CHECK_SAMPLE_FACTOR * samples, n))
    check_fractions = np.array([(manipulabilities(orders[number], q) >= thresholds[-2]).mean() for number in front_orders])
    retained = _find_front(lengths[front_orders], check_fractions)
    home_value = float(np.sqrt(kernel.rows(lines.ravel(), np.zeros((1, n)))[0, 0]))
    return JointOrders(
        orders=orders,
        thresholds=thresholds,
        counts=counts,
        mean=mean,
        lengths=lengths,
        front=front_orders[retained],
        fresh=check_fractions[retained],
        at_home=home_value,
        samples=samples,
        seed=seed,
    )


def find_distinct_orders(w: FloatArray, o: FloatArray) -> NDArray[np.int64]:
    """Return the orders (D, n) of lines that make different arms: one of an order and its reverse, and one of those equal by
    symmetry.

    Lines are alike if what does not depend on frames and on the senses of the axes is: for every two, and as a product for
    every three of them, cosine and mutual moment of the axes, and their distance.

    Args:
        w: (n, 3) unit directions.
        o: (n, 3) points, m.

    Source: derived here.
    """
    n = len(w)
    orders = np.array([order for order in permutations(range(n)) if order[0] < order[-1]])
    v = np.cross(o, w)
    distances = _compute_line_distances(w, o)
    tables = [w @ w.T, w @ v.T + v @ w.T]
    pairs, triples = (np.array(list(combinations(range(n), size))).reshape(-1, size) for size in (2, 3))

    def compute_invariants(subset: NDArray[np.int64]) -> FloatArray:
        a, b = subset[:, pairs].transpose(2, 0, 1)
        c, d, e = subset[:, triples].transpose(2, 0, 1)
        features = [abs(t[a, b]) for t in (*tables, distances)] + [t[c, d] * t[d, e] * t[e, c] for t in tables]
        return (
            np.round(
                np.concatenate([*features, tables[0][c, d] * tables[1][d, e] * tables[1][e, c]], axis=1), _INVARIANT_DECIMALS
            )
            + 0.0
        )

    forward, backward = compute_invariants(orders), compute_invariants(orders[:, ::-1])
    differs = forward != backward
    first_difference = differs.argmax(axis=1)[:, None]
    is_later = np.take_along_axis(forward, first_difference, 1) > np.take_along_axis(backward, first_difference, 1)
    _, first_indices = np.unique(np.where(is_later, backward, forward), axis=0, return_index=True)
    return np.asarray(orders[np.sort(first_indices)], dtype=np.int64)


def _compute_line_distances(directions: FloatArray, origins: FloatArray) -> FloatArray:
    """Return the distances (n, n) between lines, m."""
    normal = np.cross(directions[:, None], directions[None])
    sines = np.linalg.norm(normal, axis=2)
    offsets = origins[None] - origins[:, None]
    skew_distances = abs((offsets * normal).sum(axis=2)) / np.maximum(sines, 1e-300)
    parallel_distances = np.linalg.norm(np.cross(offsets, directions[:, None]), axis=2)
    return np.asarray(np.where(sines < _PARALLEL_SINE, parallel_distances, skew_distances))


def _find_front(lengths: FloatArray, fractions: FloatArray) -> NDArray[np.int64]:
    """Return the numbers of the entries that no other beats in both length and fraction, by length."""
    order = np.lexsort((-fractions, lengths))
    best = np.maximum.accumulate(np.concatenate([[-np.inf], fractions[order][:-1]]))
    return np.asarray(order[fractions[order] > best], dtype=np.int64)


@cache
def _make_worst_case_kernel(n: int, failures: int) -> Kernel:
    """Return the kernel of the least squared relative manipulability of a pose from lines (6 n) and q (n), for all orders."""
    lines, q = ca.SX.sym("lines", 6 * n), ca.SX.sym("q", n)
    frame_rotation, frame_offset, columns = ca.SX.eye(3), ca.SX.zeros(3), []
    for index in range(n):
        axis, point = lines[6 * index : 6 * index + 3], lines[6 * index + 3 : 6 * index + 6]
        direction, position = frame_rotation @ axis, frame_rotation @ point + frame_offset
        columns.append(ca.vertcat(ca.cross(position, direction), direction))
        if index == 0:
            continue  # turning all lines together changes nothing
        cross = ca.skew(axis)
        rotation = ca.SX.eye(3) + ca.sin(q[index]) * cross + (1 - ca.cos(q[index])) * cross @ cross
        frame_offset = frame_rotation @ (point - rotation @ point) + frame_offset
        frame_rotation = frame_rotation @ rotation
    null_rows = factor_householder(ca.horzcat(*columns)).null_space_basis()
    failed_sets: FailureSets = tuple(combinations(range(n), failures))
    return Kernel(
        f"worst order {n} {failures}",
        [lines, q],
        [select_smallest([gram_determinant([null_rows[k] for k in s]) for s in failed_sets])],
    )
