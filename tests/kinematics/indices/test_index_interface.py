"""What every index answers, whatever its formula: shapes, bits, attributes, errors."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import oracles
from holdfast.core.errors import HoldfastError, InputError, TaskError
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.core.status import Status, require_ok
from holdfast.kinematics.indices import CustomIndex, by_name


@pytest.fixture(scope="module", params=[*INDEX_REGISTRY, "custom"])
def index(request, mixed7):
    if request.param == "custom":
        return CustomIndex(lambda j: ca.sumsqr(j[0, :]), mixed7, "position", name="custom")
    return oracles.index_of(request.param, mixed7, "position")


@pytest.fixture(scope="module", params=[*INDEX_REGISTRY, "custom"])
def by_pairs(request, planar4):
    if request.param == "custom":
        return CustomIndex(ca.sumsqr, planar4, "planar", failures="pairs", name="custom")
    return oracles.index_of(request.param, planar4, "planar", "pairs")


def test_shapes(index, rng):
    q = oracles.inside(index.arm, rng, 5)
    e = index.evaluate(q)
    assert (e.value.shape, e.by_failure.shape, e.worst.shape, e.status.shape) == ((5,), (5, 7), (5,), (5,))
    assert (e.worst.dtype, e.status.dtype) == (np.int64, np.uint8)
    assert index.gradient(q).shape == (5, 7)
    one = index.evaluate(q[0])
    assert (np.shape(one.value), one.by_failure.shape, np.shape(one.worst), np.shape(one.status)) == ((), (7,), (), ())
    assert index.gradient(q[0]).shape == (7,)
    assert np.shape(index(q[0])) == np.shape(index.worst_joint(q[0])) == np.shape(index.singular(q[0])) == ()
    assert index.by_joint(q[:1]).shape == (1, 7)


def test_the_same_row_has_the_same_bits_alone_and_in_any_batch(index, threads, rng):
    q = oracles.inside(index.arm, rng, 2600)
    threads(1)
    value, by_failure, gradient = index(q), index.by_joint(q), index.gradient(q)
    for count in (2, 3):
        threads(count)
        np.testing.assert_array_equal(index.by_joint(q), by_failure)
        np.testing.assert_array_equal(index.gradient(q), gradient)
    order = rng.permutation(2600)
    np.testing.assert_array_equal(index(q[order]), value[order])
    np.testing.assert_array_equal(index.gradient(q[order]), gradient[order])
    for k in (0, 17, 1023, 1024, 2599):
        assert index(q[k]) == value[k]
        np.testing.assert_array_equal(index.by_joint(q[k]), by_failure[k])
        np.testing.assert_array_equal(index.gradient(q[k]), gradient[k])
    np.testing.assert_array_equal(index.evaluate(q).value, value)


def test_the_worst_failure_is_the_one_with_the_worst_value(index, rng):
    q = oracles.inside(index.arm, rng, 200)
    values = index.by_joint(q)
    expected = values.argmax(1) if index.better == "smaller" else values.argmin(1)
    np.testing.assert_array_equal(index.worst_failure(q), expected)
    np.testing.assert_array_equal(index.worst_joint(q), expected)
    assert len(np.unique(expected)) > 1


def test_worst_joint_names_joints_not_positions(mixed7, rng):
    q = oracles.inside(mixed7, rng, 50)
    index = by_name("relative-manipulability", mixed7, "position", failures=[6, 4, 2])
    every = by_name("relative-manipulability", mixed7, "position").by_joint(q)
    np.testing.assert_array_equal(index.worst_joint(q), np.array([6, 4, 2])[every[:, [6, 4, 2]].argmin(1)])
    np.testing.assert_allclose(index.by_joint(q), every[:, [6, 4, 2]], rtol=1e-12)
    assert index.failure_names == ["j6", "j4", "j2"]


def test_pairs_have_failures_and_no_joints(by_pairs, rng):
    q = rng.uniform(-2, 2, (10, 4))
    assert by_pairs.failures == ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
    assert by_pairs.failure_names[1] == "j0+j2"
    assert by_pairs.by_joint(q).shape == (10, 6)
    assert by_pairs.worst_failure(q).shape == (10,)
    assert by_pairs.gradient(q).shape == (10, 4)
    # Cauchy-Binet: the squares of all pairs sum to C(n - m, 2), whatever the configuration.
    if by_pairs.name == "relative manipulability":
        np.testing.assert_allclose((by_pairs.by_joint(q) ** 2).sum(axis=1), 1.0, rtol=1e-9)
        np.testing.assert_allclose(by_pairs.bound, np.sqrt(1 / 8))  # less than the root of their mean, 1/6
        assert (by_pairs(q) <= by_pairs.bound).all()
    elif by_pairs.name == "ceiling fraction":
        assert by_pairs.bound == pytest.approx(1)
        assert (by_pairs(q) <= by_pairs.bound).all()
    else:
        assert by_pairs.bound is None
    with pytest.raises(TaskError, match="several joints fail together here; use worst_failure"):
        by_pairs.worst_joint(q)


def test_one_failure(mixed7, rng):
    q = oracles.inside(mixed7, rng, 4)
    for name in INDEX_REGISTRY:
        alone = oracles.index_of(name, mixed7, "position", ["j3"])
        e = alone.evaluate(q)
        assert e.by_failure.shape == (4, 1)
        np.testing.assert_allclose(e.value, oracles.index_of(name, mixed7, "position").by_joint(q)[:, 3], rtol=1e-9)
        np.testing.assert_array_equal(alone.worst_joint(q), 3)


def test_attributes(mixed7):
    for name in INDEX_REGISTRY:
        index = oracles.index_of(name, mixed7, "position")
        assert index.singular_value_by_convention == (np.inf if index.better == "smaller" else 0)
        assert index.source
        if "Abdi 2012" in INDEX_REGISTRY[name].properties:
            assert index.better == ("smaller" if name == "condition-number" else "larger")
            assert (index.bound is None) == (name not in ("relative-manipulability", "ceiling-fraction"))
            assert "Abdi et al. 2012, eq." in index.source
        assert (index.arm, index.task.name) == (mixed7, "position")
        assert index.describe() == f"worst-case {index.name} over any one joint, task position (3 rows)"
        assert oracles.index_of(name, mixed7, "position", "pairs").describe().count("21 failure sets") == 1
    for name in ("relative-manipulability", "condition-number"):
        assert by_name(name, mixed7).unit == "1"
    assert by_name("manipulability", mixed7).unit == "m^3"
    assert by_name("manipulability", mixed7, length=2.0).unit == "1"
    assert by_name("minimum-singular-value", mixed7, length=2.0).unit == "1"
    assert "mixed" in by_name("minimum-singular-value", mixed7).unit


def test_errors_say_what_would_be_right(mixed7, planar4):
    with pytest.raises(TaskError, match="index 'rho' is not known; use one of relative-manipulability"):
        by_name("rho", mixed7)
    for name in INDEX_REGISTRY:
        with pytest.raises(TaskError, match="'planar-4' is not redundant for task 'pose': 4 joints for 6 rows"):
            oracles.index_of(name, planar4)
        with pytest.raises(TaskError, match="locking 2 of the 7 joints of 'random-RRPRRRR' leaves 5 for the 6 rows"):
            oracles.index_of(name, mixed7, "pose", "pairs")
        with pytest.raises(TaskError, match="is not redundant"):
            oracles.index_of(name, planar4, ["vx", "vy", "vz", "wx"])  # n = m
        index = oracles.index_of(name, mixed7, "position")
        for bad in (np.zeros(6), np.zeros((2, 8)), np.zeros((1, 1, 7))):
            with pytest.raises(InputError, match="7"):
                index.evaluate(bad)
    with pytest.raises(TaskError, match=r"its formula returned shape \(3, 3\); it must return one scalar"):
        CustomIndex(lambda j: j @ j.T, mixed7, "position", name="square")([0.0] * 7)
    with pytest.raises(TaskError, match="better is 'bigger'; it must be 'larger' or 'smaller'"):
        CustomIndex(ca.sumsqr, mixed7, "position", better="bigger")
    with pytest.raises(TaskError, match="is not redundant"):
        CustomIndex(ca.sumsqr, planar4)


def test_status_sentences():
    assert Status(3) is Status.SINGULAR
    for status in Status:
        assert status.sentence
    require_ok(np.zeros(3, dtype=np.uint8), "the test")
    with pytest.raises(HoldfastError, match="the test: 2 of 4 rows failed; first: row 1, bad_input: the input held NaN"):
        require_ok(np.array([0, 2, 0, 1], dtype=np.uint8), "the test")
    with pytest.raises(HoldfastError, match="1 of 1 rows failed; first: row 0, not_found"):
        require_ok(np.uint8(1), "the test")
