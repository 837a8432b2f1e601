"""The search: quantiles and fronts against their definitions, reach against closed forms, and optima that are known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import mstats

import holdfast as hf
import oracles
from holdfast.core.errors import InputError
from holdfast.core.probability.distribution import Distribution
from holdfast.studies.designs import design_space
from holdfast.studies.designs.evaluation import Evaluator
from holdfast.studies.designs.family import Family
from holdfast.studies.designs.quantile import compute_lower_quantile, compute_quantile_weights
from holdfast.studies.designs.reach import ReachEvaluator
from holdfast.studies.designs.search import _DesignSearch, find_pareto_front

# ---- quantiles and fronts --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("level", [0.5, 0.9, 0.95])
def test_guaranteed_is_the_quantile_of_the_distribution(rng, level):
    value = rng.random((4, 60))
    value[:, :5] = 0.0
    weights = rng.integers(1, 5, 60).astype(float)
    for row, plain, weighted in zip(
        value, compute_lower_quantile(value, level), compute_lower_quantile(value, level, weights), strict=True
    ):
        assert plain == Distribution.from_values(row, "larger").quantile(1 - level)
        assert weighted == Distribution.from_values(row, "larger", weights=weights).quantile(1 - level)


def test_smooth_quantile_is_that_of_harrell_and_davis(rng):
    value = rng.normal(size=(3, 81))
    share = compute_quantile_weights(value, 0.95)
    np.testing.assert_allclose(share.sum(axis=1), 1.0)
    ours = (share * value).sum(axis=1)
    np.testing.assert_allclose(ours, np.ravel(mstats.hdquantiles(value.T, prob=[0.05], axis=0)), rtol=1e-10)
    twice = np.repeat(value, 2, axis=1)
    assert np.abs(compute_quantile_weights(value, 0.95, np.full(81, 2.0)) - share).max() < 1e-12
    assert (compute_quantile_weights(twice, 0.95) * twice).sum(axis=1) == pytest.approx(ours, abs=0.3)


def test_front_is_what_no_other_design_beats(rng):
    reach, value = rng.integers(0, 12, 60) / 4.0, rng.integers(0, 12, 60) / 4.0
    front = find_pareto_front(reach, value)
    assert (np.diff(reach[front]) > 0).all()
    assert (np.diff(value[front]) < 0).all()
    beaten = [
        any(
            (reach[k] >= reach[i]) & (value[k] >= value[i]) & ((reach[k] > reach[i]) | (value[k] > value[i])) for k in range(60)
        )
        for i in range(60)
    ]
    assert not any(beaten[i] for i in front)
    left = {(reach[i], value[i]) for i in range(60) if not beaten[i]}
    assert left == {(reach[i], value[i]) for i in front}


# ---- reach -----------------------------------------------------------------------------------------------------------


def test_reach_of_a_stretched_arm_is_the_sum_of_its_links():
    arm = hf.Arm.from_dh([hf.DH(a=a, alpha=0.0, lower=-2.0, upper=2.0) for a in (1.0, 0.8, 0.6)])
    space = design_space(arm, {"a1": (0.5, 1.5), "a3": (0.3, 1.0)})
    family = Family(space, task="planar")
    values = space.draw(4)
    reach, slope = ReachEvaluator(family)(values, Evaluator(family, np.eye(4)[None]).finite_limits(values))
    np.testing.assert_allclose(reach, values.sum(axis=1) + 0.8, rtol=1e-10)
    np.testing.assert_allclose(slope, 1.0, rtol=1e-7)


def test_reach_within_limits_against_a_bounded_optimiser(rng):
    arm = oracles.random_arm(rng, types="RRPRR", limits=1.0)
    space = design_space(arm, {"d2": (-3.0, 3.0), "tool.x": (-1.0, 1.0), "upper4": (0.3, 1.5)})
    family = Family(space, task="position")
    values, reaches, limits = space.draw(2), ReachEvaluator(family), Evaluator(family, np.eye(4)[None]).finite_limits
    reach, slope = reaches(values, limits(values))
    for x, ours in zip(values, reach, strict=True):
        one = space.arm_of(x)

        def short(q, one=one):
            return -np.linalg.norm(oracles.forward(one, q[None])[0, :3, 3] - one.base[:3, 3])

        starts = rng.uniform(one.lower, one.upper, (5, one.n))
        best = -min(minimize(short, q, bounds=list(zip(one.lower, one.upper, strict=True))).fun for q in starts)
        assert ours >= best - 1e-5
        q = rng.uniform(one.lower, one.upper, (20_000, one.n))
        from_base = np.linalg.norm(one.forward_kinematics(q)[:, :3, 3] - one.base[:3, 3], axis=1)
        assert ours >= from_base.max() - 1e-9
        assert ours <= best + 1e-2
    h = 1e-6
    for k in range(len(space.names)):
        step = h * np.eye(len(space.names))[k]
        sides = [reaches(values + sign * step, limits(values + sign * step))[0] for sign in (1, -1)]
        np.testing.assert_allclose((sides[0] - sides[1]) / (2 * h), slope[:, k], atol=1e-4)


# ---- the search ------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def small(region3, space3):
    return {
        "region": region3,
        "task": "planar",
        "poses": 32,
        "designs": 24,
        "local_searches": 2,
        "check_poses": 100,
        "seed": 1,
    }


@pytest.fixture(scope="module")
def searched(planar3, space3, small):
    return hf.design(planar3, space3, **small)


def test_equal_outer_links_held_parallel_attain_the_bound_everywhere(rng):
    """The optimum that the search of a planar 3R must find: with a1 = a3 and q3 = -q2 all three minors of J are equal."""
    a, b = rng.uniform(0.3, 1.5, 2)
    arm = hf.Arm.from_dh([hf.DH(a=x, alpha=0.0) for x in (a, b, a)])
    q = rng.uniform(-np.pi, np.pi, (50, 3))
    q[:, 2] = -q[:, 1]
    np.testing.assert_allclose(hf.indices.relative_manipulability(arm, "planar")(q), np.sqrt(1 / 3), rtol=1e-9)


def test_the_search_finds_the_known_optimum_of_a_planar_arm(searched):
    bound = np.sqrt(1 / 3)
    assert searched.guaranteed[searched.best] == pytest.approx(bound, abs=1e-3)
    assert (searched.guaranteed <= bound + 1e-9).all()
    best = searched.values[searched.best]
    assert best[0] == pytest.approx(best[2], abs=0.02)  # outer links equally long
    given, found = searched.checked.given, searched.checked.best
    assert found.guaranteed.low <= found.guaranteed.value <= found.guaranteed.high
    assert found.guaranteed.value > given.guaranteed.value
    assert searched.checked.optimism == pytest.approx(searched.guaranteed[searched.best] - found.guaranteed.value)


def test_no_design_guarantees_as_much_as_the_best_and_reaches_farther(searched):
    """Of this arm whole families of designs attain the bound."""
    value = searched.guaranteed[searched.best]
    alike = np.abs(searched.guaranteed - value) <= 1e-4 * value
    assert searched.reach[searched.best] >= searched.reach[alike].max()
    assert searched.best in searched.front


def test_what_the_search_reports_is_what_the_arms_are_worth(searched, planar3):
    arm = searched.arm()
    run = hf.assess(arm, searched.region, hf.indices.relative_manipulability(arm, "planar"), poses=100, seed=9, optimise=True)
    assert float(run.distribution_of(True).quantile(0.05, reachable_only=False)) == pytest.approx(np.sqrt(1 / 3), abs=2e-3)
    np.testing.assert_array_equal(searched.values[0], searched.space.start)
    assert searched.start_reach == searched.reach[0]
    assert len(searched.values) == 1 + searched.screened + searched.climbs


def test_the_same_seed_gives_the_same_bits_with_one_thread_and_after_a_stop(
    searched, planar3, space3, small, tmp_path, threads
):
    threads(1)
    calls = []

    def stop(done, total):
        calls.append((done, total))
        if done > 25:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        hf.design(planar3, space3, **small, store=tmp_path / "s", progress=stop)
    assert calls[-1][0] <= calls[-1][1]
    again = hf.design(planar3, space3, **small, store=tmp_path / "s")
    for name in ("values", "guaranteed", "reach", "reached", "front"):
        np.testing.assert_array_equal(getattr(again, name), getattr(searched, name))
    assert again.checked.best.guaranteed == searched.checked.best.guaranteed
    np.testing.assert_array_equal(again.checked.best.distribution.values, searched.checked.best.distribution.values)


def test_the_slope_that_climbs_is_that_of_the_smooth_quantile(space3, family3, region3):
    search = _DesignSearch(family3, region3, 0.75, 32, 0)
    x = np.array([0.9, 0.9, 0.7, 1.4, -1.5])
    found = search.evaluator(x[None])
    value, slope = search.evaluate_smooth_quantile(found)
    direction, h = np.array([0.5, -0.2, 0.3, 0.4, 0.3]), 1e-6
    sides = []
    for sign in (1, -1):
        moved = search.evaluator._search_configurations((x + sign * h * direction)[None], found.kept, 0)
        sides.append(search.evaluate_smooth_quantile(moved)[0])
    assert (sides[0] - sides[1]) / (2 * h) == pytest.approx(float(slope @ direction), rel=1e-3, abs=1e-4)
    assert value <= np.sqrt(1 / 3)


@pytest.mark.parametrize(
    ("option", "words"),
    [
        ({"level": 1.0}, "level is 1"),
        ({"poses": 0}, "poses is 0"),
        ({"designs": 0}, "designs is 0"),
        ({"local_searches": -1}, "local_searches is -1"),
    ],
)
def test_options_out_of_range_are_refused(planar3, space3, option, words):
    with pytest.raises(InputError, match=words):
        hf.design(planar3, space3, task="planar", **option)


def test_a_region_of_joints_is_refused(planar3, space3):
    with pytest.raises(InputError, match="no poses to reach"):
        hf.design(planar3, space3, region=hf.Region.joints([-1, -1, -1], [1, 1, 1]), task="planar")
