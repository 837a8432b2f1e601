"""All simple arrangements of n pseudolines, as signs of the minors of n lines in space: the classes of theorem R4.

A uniform oriented matroid of rank 3 is a sign for every three of n elements such that in each relation
``D_abc D_ade - D_abd D_ace + D_abe D_acd = 0`` the three products could cancel. Two are of one class if relabelling elements
and turning some of them round makes them the same. Every one of n elements extends one of n - 1, so that the list is complete.
"""

from __future__ import annotations

from functools import cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

Signs = NDArray[np.int8]

CLASS_COUNTS = {3: 1, 4: 1, 5: 1, 6: 4, 7: 11, 8: 135, 9: 4382}
"""Classes that the literature on simple arrangements counts."""


@cache
def index_triples(n: int) -> NDArray[np.int64]:
    """Return all (C(n, 3), 3) triples of 0 .. n - 1, in order."""
    return np.array(list(combinations(range(n), 3)))


@cache
def minor_relations(n: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the relations among minors: three products of two triples each.

    Returns:
        Numbers of the triples (R, 3, 2), and the sign (R, 3) of each product where every minor is positive.
    """
    number = {tuple(t): i for i, t in enumerate(index_triples(n).tolist())}
    pairs, signs = [], []
    for five in combinations(range(n), 5):
        for a in five:
            b, c, d, e = (x for x in five if x != a)
            row, sign = [], []
            for side, (first, second) in zip((1, -1, 1), (((b, c), (d, e)), ((b, d), (c, e)), ((b, e), (c, d))), strict=True):
                row.append([number[tuple(sorted((a, *x)))] for x in (first, second)])
                sign.append(side * _permutation_sign(a, first) * _permutation_sign(a, second))
            pairs.append(row)
            signs.append(sign)
    return np.array(pairs, dtype=np.int64).reshape(-1, 3, 2), np.array(signs, dtype=np.int64).reshape(-1, 3)


def _permutation_sign(a: int, pair: tuple[int, int]) -> int:
    """Return the sign of the permutation that orders ``(a, *pair)``; the pair is in order."""
    return -1 if pair[0] < a < pair[1] else 1


def is_oriented_matroid(n: int, signs: Signs) -> NDArray[np.bool_]:
    """Return whether each row of signs (B, C(n, 3)) belongs to an oriented matroid: no relation has three products
    of one sign.
    """
    pairs, side = minor_relations(n)
    products = signs[:, pairs[:, :, 0]] * signs[:, pairs[:, :, 1]] * side.astype(np.int8)
    return np.asarray((abs(products.sum(axis=2, dtype=np.int8)) == 1).all(axis=1))


@cache
def arrangement_classes(n: int) -> Signs:
    """Return one oriented matroid of each class of n elements, 3 to 9, as signs (K, C(n, 3)) of its triples.

    Those that contain element 0 are all positive: the others cross it one after the other.
    """
    if n == 3:
        return np.ones((1, 1), dtype=np.int8)
    class_codes: set[int] = set()
    for parent in arrangement_classes(n - 1):
        class_codes.update(np.unique(_class_codes(n, _extend_signs(n, parent))).tolist())
    codes = np.array(sorted(class_codes), dtype=np.uint64)
    signs = np.ones((len(codes), len(index_triples(n))), dtype=np.int8)
    without = np.flatnonzero((index_triples(n) > 0).all(axis=1))
    signs[:, without] = 1 - 2 * ((codes[:, None] >> np.arange(len(without), dtype=np.uint64)) & np.uint64(1)).astype(np.int8)
    return signs


def _extend_signs(n: int, parent: Signs) -> Signs:
    """Return all oriented matroids of n elements whose first n - 1 have the given signs, (B, C(n, 3))."""
    all_triples, new_triples = index_triples(n), np.flatnonzero(index_triples(n)[:, 2] == n - 1)
    signs = np.zeros((1, len(all_triples)), dtype=np.int8)
    signs[0, all_triples[:, 2] < n - 1] = parent
    pairs, side = minor_relations(n)
    order = new_triples[
        np.lexsort((all_triples[new_triples, 0], all_triples[new_triples, 1]))
    ]  # (0, 1), (0, 2), (1, 2), (0, 3), ...
    rank = np.full(len(all_triples), -1)
    rank[order] = np.arange(len(order))
    last = rank[pairs].reshape(-1, 6).max(axis=1)  # after which sign all of a relation are known
    for step, triple in enumerate(order):
        signs = np.repeat(signs, 2, axis=0)
        signs[::2, triple], signs[1::2, triple] = 1, -1
        now, of = pairs[last == step], side[last == step].astype(np.int8)
        products = signs[:, now[:, :, 0]] * signs[:, now[:, :, 1]] * of
        signs = signs[(abs(products.sum(axis=2, dtype=np.int8)) == 1).all(axis=1)]
    return signs


def _class_codes(n: int, signs: Signs) -> NDArray[np.uint64]:
    """Return a number for the class of each row: the least over all choices of first and second element and both directions."""
    cube, every = np.zeros((len(signs), n, n, n), dtype=np.int8), index_triples(n)
    for order, sign in (((0, 1, 2), 1), ((1, 2, 0), 1), ((2, 0, 1), 1), ((1, 0, 2), -1), ((0, 2, 1), -1), ((2, 1, 0), -1)):
        cube[:, every[:, order[0]], every[:, order[1]], every[:, order[2]]] = sign * signs
    rows, inner = np.arange(len(signs))[:, None], index_triples(n - 1)
    weights = np.uint64(1) << np.arange(len(inner), dtype=np.uint64)
    mask = np.uint64((1 << len(inner)) - 1)
    smallest_code = np.full(len(signs), np.iinfo(np.uint64).max)
    for first in range(n):
        others = np.array([x for x in range(n) if x != first])
        around = cube[:, first][:, others[:, None], others]
        for second in range(n - 1):
            for direction in (1, -1):
                # Turned round so that the first and the second are before all others, which then have an order.
                turn = np.where(np.arange(n - 1) == second, 1, direction * around[:, second]).astype(np.int8)
                before = direction * around * turn[:, :, None] * turn[:, None, :]
                place = np.argsort((before < 0).sum(axis=2), axis=1)
                named, turned = others[place], np.take_along_axis(turn, place, axis=1)
                i, j, k = inner.T
                shown = cube[rows, named[:, i], named[:, j], named[:, k]] * turned[:, i] * turned[:, j] * turned[:, k]
                code = ((shown < 0) * weights).sum(axis=1, dtype=np.uint64)
                smallest_code = np.minimum(smallest_code, np.minimum(code, code ^ mask))
    return smallest_code
