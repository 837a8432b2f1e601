"""Ceilings: proven bounds against random null spaces, stored null spaces against code that shares nothing with the search."""

import re
from itertools import combinations
from math import comb, pi, sin, sqrt  # the closed forms use them

import numpy as np
import pytest

import holdfast as hf
from holdfast.kinematics.index_bounds.manipulability_bounds import _read_null_spaces, read_closed_forms

CASES = [(n, m, k) for m in range(2, 7) for n in range(m + 2, 11) for k in (2, 3) if k <= n - m]
KNOWN = ["4,2,2", "5,2,3", "5,3,2", "6,3,2", "6,3,3", "6,4,2", "7,4,3", "7,5,2", "8,5,3", "8,6,2", "9,6,3", "10,5,2"]


def least(null, k):
    """The checker: minors of the rows by determinants of Gram matrices."""
    rows = np.array(list(combinations(range(null.shape[-2]), k)))
    some = null[..., rows, :]
    return np.sqrt(np.maximum(np.linalg.det(some @ np.swapaxes(some, -1, -2)), 0)).min(axis=-1)


def test_every_size_is_stored_and_its_null_space_is_worth_what_is_said():
    stored = _read_null_spaces()
    assert sorted(stored) == sorted(CASES)
    for n, m, k in CASES:
        null, c = np.array(stored[n, m, k]), hf.index_bounds.upper_bound(n=n, m=m, k=k)
        assert null.shape == (n, n - m)
        assert abs(null.T @ null - np.eye(n - m)).max() < 1e-14
        assert least(null, k) == pytest.approx(c.best_known, abs=1e-12)
        assert least(null, k) <= c.bound * (1 + 1e-12)
        assert c.bound <= sqrt(comb(n - m, k) / comb(n, k)) * (1 + 1e-15)
        assert c.verify() is c


@pytest.mark.parametrize(("n", "m", "k"), [case for case in CASES if case[2] == case[0] - case[1]])
def test_the_orthogonal_complement_of_a_stored_null_space_is_known_as_well(n, m, k):
    """Theorem T3, by determinants: minors of k = n - m rows of N are those of the other m rows of its complement."""
    stored, c = np.array(_read_null_spaces()[n, m, k]), hf.index_bounds.upper_bound(n=n, m=k, k=m)
    assert c.null_space.shape == (n, m)
    assert least(c.null_space, m) == pytest.approx(c.best_known, abs=1e-12)
    assert c.best_known >= least(stored, k) * (1 - 1e-12)
    assert c.is_attained == hf.index_bounds.upper_bound(n=n, m=m, k=k).is_attained
    assert c.verify() is c


def test_seven_joints_three_rows_four_failures():
    c = hf.index_bounds.upper_bound(n=7, m=3, k=4)
    assert c.best_known == pytest.approx(0.0867754, abs=5e-8)
    assert c.is_attained


def test_the_known_ceilings_are_attained():
    found = [f"{c.n},{c.m},{c.k}" for c in hf.index_bounds.bound_table().ceilings if c.is_attained]
    assert sorted(found) == sorted(KNOWN)
    for name in KNOWN:
        c = hf.index_bounds.upper_bound(**dict(zip("nmk", map(int, name.split(",")), strict=True)))
        assert c.best_known == pytest.approx(c.bound, rel=1e-9)


@pytest.mark.parametrize(("n", "m"), [(7, 6), (9, 6), (11, 4), (6, 5), (12, 3)])
def test_one_failure_and_tasks_of_one_row_are_attained_for_any_number_of_joints(n, m):
    c = hf.index_bounds.upper_bound(n=n, m=m)
    assert c.is_attained
    assert least(c.null_space, 1) == pytest.approx(sqrt((n - m) / n), rel=1e-12)
    one = hf.index_bounds.upper_bound(n=n, m=1, k=3)
    assert least(one.null_space, 3) == pytest.approx(one.bound, rel=1e-12) == pytest.approx(sqrt((n - 3) / n), rel=1e-12)


@pytest.mark.parametrize("n", [4, 7, 13])
def test_two_of_two_are_the_regular_star_and_its_complement(n):
    best = 2 / n * sin(pi / n)
    for m, k in ((n - 2, 2), (2, n - 2)):
        c = hf.index_bounds.upper_bound(n=n, m=m, k=k)
        assert c.is_attained
        assert c.bound == pytest.approx(best, rel=1e-14)
        assert least(c.null_space, k) == pytest.approx(best, rel=1e-9)


@pytest.mark.parametrize("n", [6, 8, 10, 14])
def test_two_bundles_and_two_single_lines_are_the_best_known_for_even_numbers_of_joints(n):
    c, h = hf.index_bounds.upper_bound(n=n, m=2, k=2), n // 2
    assert least(c.null_space, 2) == pytest.approx(sqrt((sqrt(4 * h * h - 4 * h + 9) - h - 2) / (h - 1)), rel=1e-13)
    if n <= 10:
        assert least(np.array(_read_null_spaces()[n, 2, 2]), 2) == pytest.approx(c.best_known, rel=1e-12)
    assert c.best_known < c.bound < 1.01 * c.best_known


def test_closed_forms_have_the_digits_of_the_best_known_values():
    for (n, m, k), text in read_closed_forms().items():
        value = eval(re.sub(r"(?<=[\d)]) (?=sqrt|sin)", " * ", text))
        assert hf.index_bounds.upper_bound(n=n, m=m, k=k).best_known == pytest.approx(value, rel=1e-12), (n, m, k)


@pytest.mark.parametrize("size", [(6, 2, 3), (6, 3, 3), (7, 4, 3), (9, 6, 2), (8, 5, 2), (10, 6, 3)])
def test_no_random_null_space_beats_the_bound(size, rng):
    n, m, k = size
    null = np.linalg.qr(rng.normal(size=(3000, n, n - m)))[0]
    assert 0 < least(null, k).max() <= hf.index_bounds.upper_bound(n=n, m=m, k=k).bound


def test_bounds_are_consistent():
    """No bound lies above a product of those of locks one after the other, nor do more failures leave more."""
    for n, m, k in CASES:
        c = hf.index_bounds.upper_bound(n=n, m=m, k=k)
        for j in range(1, k):
            product = (
                hf.index_bounds.upper_bound(n=n, m=m, k=j).bound * hf.index_bounds.upper_bound(n=n - j, m=m, k=k - j).bound
            )
            assert c.bound <= product * (1 + 1e-12)
        assert c.bound < hf.index_bounds.upper_bound(n=n, m=m, k=k - 1).bound


def test_a_ceiling_of_an_index(pa10):
    two = hf.indices.relative_manipulability(pa10, "pose", 2)
    c = hf.index_bounds.bound_of_index(two)
    assert (c.n, c.m, c.k) == (9, 6, 2)
    assert (two.bound, two.best_known, two.is_attained) == (c.bound, c.best_known, False)
    assert c.bound == pytest.approx(sqrt(1 / 15))
    assert c.best_known == pytest.approx(sqrt(3) / 7)
    assert c.compare_value(0.1717) == "69.4 % of the best known 0.2474; no arm can exceed 0.2582"
    mixed = hf.indices.relative_manipulability(pa10, "pose", [*([i] for i in range(9)), *combinations(range(9), 2)])
    assert hf.index_bounds.bound_of_index(mixed).bound == c.bound
    assert hf.index_bounds.bound_of_index(hf.indices.relative_manipulability(pa10, "pose", [0, 1])) is None
    one = hf.indices.relative_manipulability(pa10)
    assert one.is_attained
    assert one.bound_note == ""


@pytest.mark.parametrize(
    ("size", "said"),
    [
        ({"n": 6, "m": 6}, "no redundancy, so no joint may fail"),
        ({"n": 8, "m": 6, "k": 3}, "after 3 failures the task has 5 joints for 6 rows"),
        ({"n": 8, "m": 6, "k": 0}, "at least one joint must fail"),
        ({"n": 8.0, "m": 6}, "n is 8.0; it must be a whole number"),
        ({"n": 8, "m": 0}, "a task has at least 1 row"),
        ({"n": 1000, "m": 6}, "more than the 200"),
    ],
)
def test_sizes_that_have_no_ceiling(size, said):
    with pytest.raises(hf.InputError, match=said):
        hf.index_bounds.upper_bound(**size)


def test_a_stored_null_space_that_is_wrong_is_refused():
    c = hf.index_bounds.upper_bound(n=9, m=6, k=2)
    c.__dict__["null_space"] = c.null_space * (1 + 1e-9)
    with pytest.raises(hf.InputError, match="is not orthonormal"):
        c.verify()
    beaten = hf.index_bounds.UpperBound(n=9, m=6, k=2, bound=0.2, bound_by="R2")
    with pytest.raises(hf.InputError, match="one of the two is wrong"):
        beaten.verify()


@pytest.mark.parametrize(
    ("rates", "m", "value"),
    [
        ((0.3, 0.2, 0.2, 0.1, 0.1, 0.05, 0.05), 6, 0.441588),
        ((0.3, 0.2, 0.2, 0.1, 0.1, 0.05, 0.05), 5, 0.624500),
        ((0.5, 0.3, 0.1, 0.1), 2, 0.831662),
        ((1, 1, 1, 1, 1, 1, 1), 6, sqrt(1 / 7)),
    ],
)
def test_the_best_average_over_failures_at_known_rates(rates, m, value, rng):
    """R5: attained by the null space that comes with it, and by none of many others."""
    found = hf.index_bounds.bound_average(rates, m)
    assert found.value == pytest.approx(value, abs=1e-6)
    null, n = found.null_space, len(rates)
    assert abs(null.T @ null - np.eye(n - m)).max() < 1e-12
    assert np.linalg.norm(null, axis=1) == pytest.approx(found.left, abs=1e-9)
    weight = np.array(rates) / sum(rates)
    assert weight @ np.linalg.norm(null, axis=1) == pytest.approx(found.value, abs=1e-9)
    others = np.linalg.norm(np.linalg.qr(rng.normal(size=(2000, n, n - m)))[0], axis=2) @ weight
    assert 0.8 * found.value < others.max() <= found.value
    with pytest.raises(hf.InputError, match="one positive number for each joint"):
        hf.index_bounds.bound_average([0.5, -0.5, 1], 2)
    with pytest.raises(hf.InputError, match="m must be from 1 to"):
        hf.index_bounds.bound_average(rates, n)
