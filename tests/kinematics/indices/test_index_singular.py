"""The singular convention, its threshold, and rows that hold NaN."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import oracles
from holdfast import indices
from holdfast.core.errors import InputError
from holdfast.core.registry import INDEX_REGISTRY
from holdfast.core.status import Status
from holdfast.kinematics.indices import SINGULAR_RATIO, CustomIndex


@pytest.mark.parametrize("name", INDEX_REGISTRY)
def test_a_singular_configuration(name, pa10, rng):
    """q = 0 of the PA10 has three zero singular values; section 6 of probabilistic-tolerance.md."""
    index = oracles.index_of(name, pa10)
    zero = np.zeros(9)
    assert index(zero) == index.singular_value_by_convention
    np.testing.assert_array_equal(index.by_joint(zero), index.singular_value_by_convention)
    np.testing.assert_array_equal(index.gradient(zero), 0)
    assert index.singular(zero)
    assert index.evaluate(zero).status == Status.SINGULAR
    q = oracles.inside(pa10, rng, 21)
    q[[0, 7, 20]] = 0
    q[7, [0, 8]] = 0.4  # still singular: the first and the last joint do not matter
    e = index.evaluate(q)
    expected = np.isin(np.arange(21), [0, 7, 20])
    np.testing.assert_array_equal(e.status == Status.SINGULAR, expected)
    np.testing.assert_array_equal(index.singular(q), expected)
    np.testing.assert_array_equal(e.value[expected], index.singular_value_by_convention)
    assert np.isfinite(e.value[~expected]).all()
    np.testing.assert_array_equal(index(q), e.value)
    for a, b in ((index.worst_case(q), e), (index.worst_case(zero), index.evaluate(zero))):
        for what in ("value", "worst", "status"):
            np.testing.assert_array_equal(getattr(a, what), getattr(b, what))
    g = index.gradient(q)
    np.testing.assert_array_equal(g[expected], 0)
    np.testing.assert_array_equal(g[~expected], index.gradient(q[~expected]))


@pytest.fixture(scope="module")
def nearly_straight(flat4):
    """``(ratio) -> q`` with sigma_min / sigma_max of the planar task at that ratio, to a part in a thousand."""

    def of(ratio):
        def configuration(bend):
            return np.array([0.3, bend, 0.4 * bend, -0.7 * bend])

        s = np.linalg.svd(oracles.jacobian(flat4, configuration(1e-5)[None])[0, :2], compute_uv=False)
        return configuration(1e-5 * ratio / (s[1] / s[0]))

    return of


@pytest.mark.parametrize("name", INDEX_REGISTRY)
@pytest.mark.parametrize(("ratio", "singular"), [(1e-6, False), (1e-11, False), (1e-13, True)])
def test_the_threshold(name, ratio, singular, flat4, nearly_straight):
    q = nearly_straight(ratio)
    s = np.linalg.svd(oracles.jacobian(flat4, q.astype(np.longdouble)[None])[0, :2].astype(float), compute_uv=False)
    assert s[1] / s[0] == pytest.approx(ratio, rel=0.01)
    index = oracles.index_of(name, flat4, "planar")
    e = index.evaluate(q)
    assert bool(index.singular(q)) == singular
    assert e.status == (Status.SINGULAR if singular else Status.OK)
    if singular:
        assert e.value == index.singular_value_by_convention
        np.testing.assert_array_equal(index.gradient(q), 0)
    else:
        assert np.isfinite(e.by_failure).all()
        assert np.isfinite(index.gradient(q)).all()
        assert (e.by_failure > 0).all()
    assert index(q) == e.value


@pytest.mark.skipif(not oracles.LONG, reason="long double is double here")
def test_rho_just_above_the_threshold_is_still_rho(flat4, nearly_straight):
    q = nearly_straight(1e-11)
    rho = oracles.rho_long(oracles.jacobian(flat4, q.astype(np.longdouble)[None])[0, :2])
    np.testing.assert_allclose(indices.relative_manipulability(flat4, "planar").by_joint(q), rho, atol=1e-4)


def test_all_indices_agree_on_what_is_singular(flat4, nearly_straight, rng):
    q = np.array([nearly_straight(r) for r in 10 ** rng.uniform(-14, -10, 60) if abs(np.log10(r / SINGULAR_RATIO)) > 0.02])
    statuses = [oracles.index_of(name, flat4, "planar").evaluate(q).status for name in INDEX_REGISTRY]
    own = CustomIndex(ca.sumsqr, flat4, "planar")
    for status in (*statuses, own.evaluate(q).status):
        np.testing.assert_array_equal(status, statuses[0])
    assert 5 < (statuses[0] == Status.SINGULAR).sum() < 50
    np.testing.assert_array_equal(indices.relative_manipulability(flat4, "planar").singular(q), statuses[0] == Status.SINGULAR)


@pytest.mark.parametrize("length", [1e-3, 1.0, 1e3])
def test_the_definition_uses_the_task_jacobian_with_its_length(length, pa10, rng):
    """Close to q = 0: the status is that of sigma_m <= 1e-12 sigma_1 of the scaled Jacobian, also when rho has no margin."""
    q = oracles.near_singular(rng, 9, 300, 1e-15, 1e-3)
    s = np.linalg.svd(oracles.task_jacobian(pa10, q, "pose", length=length), compute_uv=False)
    ratio = s[:, -1] / s[:, 0]
    clear = np.abs(np.log10(np.maximum(ratio, 1e-300) / SINGULAR_RATIO)) > 0.6
    for name in ("relative-manipulability", "manipulability", "mean-singular-value"):
        status = oracles.index_of(name, pa10, length=length).evaluate(q).status
        np.testing.assert_array_equal(status[clear] == Status.SINGULAR, ratio[clear] <= SINGULAR_RATIO)
    assert 20 < (ratio[clear] <= SINGULAR_RATIO).sum() < clear.sum() - 20


@pytest.mark.parametrize("name", INDEX_REGISTRY)
def test_a_failure_that_ends_the_task_is_an_ordinary_zero(name, pa10_7):
    """The elbow of the 7-joint PA10: not singular before, singular after."""
    index = oracles.index_of(name, pa10_7)
    q = np.radians([10.0, 35, -20, 70, 15, 50, 0])
    e = index.evaluate(q)
    assert e.status == Status.OK
    assert e.worst == 3 or name == "mean-singular-value"
    if name == "condition-number":
        assert e.value > 1e12
    elif name == "mean-singular-value":
        assert e.by_failure[3] > 0.1
    else:
        assert e.value < (1e-2 if name.startswith("geometric") else 1e-12)
    assert np.isfinite(index.gradient(q)).all()


@pytest.mark.parametrize("bad", [np.nan, np.inf])
@pytest.mark.parametrize("name", [*INDEX_REGISTRY, "custom"])
def test_nan_in_a_batch_and_alone(name, bad, mixed7, rng):
    index = CustomIndex(ca.sumsqr, mixed7, "position") if name == "custom" else oracles.index_of(name, mixed7, "position")
    q = oracles.inside(mixed7, rng, 25)
    clean, slopes = index.evaluate(q), index.gradient(q)
    q[[3, 24], [0, 6]] = bad
    others = np.delete(np.arange(25), [3, 24])
    e, g = index.evaluate(q), index.gradient(q)
    assert np.isnan(e.value[[3, 24]]).all()
    assert np.isnan(e.by_failure[[3, 24]]).all()
    assert np.isnan(g[[3, 24]]).all()
    np.testing.assert_array_equal(e.status[[3, 24]], Status.BAD_INPUT)
    alone = index.worst_case(q)
    np.testing.assert_array_equal(alone.value, e.value)
    np.testing.assert_array_equal(alone.status, e.status)
    np.testing.assert_array_equal(e.status[others], Status.OK)
    np.testing.assert_array_equal(e.value[others], clean.value[others])
    np.testing.assert_array_equal(e.by_failure[others], clean.by_failure[others])
    np.testing.assert_array_equal(g[others], slopes[others])
    np.testing.assert_array_equal(np.isnan(index(q)), np.isnan(e.value))
    assert not index.singular(q).any()
    for ask in (index, index.evaluate, index.by_joint, index.worst_failure, index.gradient, index.singular):
        with pytest.raises(InputError, match="holds NaN or infinity; give 7 finite numbers"):
            ask(q[3])


def test_nan_beside_a_singular_row(pa10):
    q = np.zeros((3, 9))
    q[1] = np.nan
    q[2] = oracles.NOMINAL
    for name in INDEX_REGISTRY:
        index = oracles.index_of(name, pa10)
        np.testing.assert_array_equal(index.evaluate(q).status, [Status.SINGULAR, Status.BAD_INPUT, Status.OK])
        np.testing.assert_array_equal(np.isnan(index(q)), [False, True, False])
        np.testing.assert_array_equal(np.isnan(index.gradient(q)).all(1), [False, True, False])
