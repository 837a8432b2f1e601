"""The statistics, against pingouin, statsmodels, closed forms and brute force."""

from itertools import product

import numpy as np
import pandas as pd
import pingouin as pg
import pytest
from scipy import integrate, stats
from statsmodels.stats.anova import AnovaRM
from statsmodels.stats.power import TTestPower

from holdfast.core.errors import InputError
from holdfast.teleop.analysis import anova, compare_pairs, correct_by_holm, correlate, power, subjects_for_f, subjects_for_t


def reference_data():
    """The reference data set of the specification, section 8."""
    s, a, b = np.ogrid[:24, :2, :3]
    return (
        1
        + 0.9 * b
        + (0.3 - 0.35 * b) * a
        + 0.2 * np.sin(1.7 * s + 1)
        + 0.15 * np.sin(2.3 * s * (a + 1) + b)
        + 0.1 * np.cos(5.1 * s + 3 * a * b)
    )


def long(y):
    s, a, b = (k.ravel() for k in np.indices(y.shape))
    return pd.DataFrame({"who": s, "first": a, "second": b, "y": y.ravel()})


def correlated(rng, n, a, b):
    mix = rng.normal(size=(a * b, a * b))
    return (rng.normal(size=(n, a * b)) @ mix + rng.normal(size=a * b)).reshape(n, a, b)


# ---- ANOVA ---------------------------------------------------------------------------------------------------------------


def test_reference_data_set():
    found = anova(reference_data())
    f = [e.F for e in found.effects]
    np.testing.assert_allclose(f, [5.0443477, 2122.20869, 102.339593], rtol=1e-8)
    assert found.effect("law").p == pytest.approx(0.0346097, abs=5e-8)
    assert found.effect("law x difficulty").p == pytest.approx(1.158e-17, rel=1e-3)
    ss = [(e.ss, e.ss_error) for e in found.effects]
    np.testing.assert_allclose(
        ss, [(0.0986334708, 0.449725109), (50.6442152, 0.548870127), (2.81508893, 0.632668582)], rtol=1e-8
    )
    assert [(e.df, e.df_error) for e in found.effects] == [(1, 23), (2, 46), (2, 46)]
    y = reference_data()
    for b, (t, p) in enumerate([(-9.1228790, 4.196e-9), (1.2931936, 0.208783), (12.2386006, 1.491e-11)]):
        pair = compare_pairs(y[:, 0, b], y[:, 1, b])
        assert pair.t == pytest.approx(t, abs=1e-7)
        assert pair.p == pytest.approx(p, rel=1e-3)


@pytest.mark.parametrize(("n", "a", "b"), [(24, 2, 3), (7, 3, 4), (5, 4, 2)])
def test_equal_to_pingouin(rng, n, a, b):
    y = correlated(rng, n, a, b)
    found = anova(y, ("first", "second"))
    table = long(y)
    theirs = {
        size: pg.rm_anova(table, dv="y", within=["first", "second"], subject="who", detailed=True, effsize=size)
        for size in ("np2", "ng2")
    }
    for k, e in enumerate(found.effects):
        row = theirs["np2"].iloc[k]
        ours = [e.F, e.df, e.df_error, e.p, e.p_gg, e.gg, e.ss, e.partial_eta2]
        names = ["F", "ddof1", "ddof2", "p_unc", "p_GG_corr", "eps", "SS", "np2"]
        np.testing.assert_allclose(ours, [row[x] for x in names], rtol=1e-8)
        assert e.generalised_eta2 == pytest.approx(theirs["ng2"].iloc[k]["ng2"], rel=1e-8)
        within = [["first"], ["second"], ["first", "second"]][k]
        averaged = table.groupby(["who", *within], as_index=False)["y"].mean()
        hf = pg.epsilon(averaged, dv="y", subject="who", within=within if k == 2 else within[0], correction="hf")
        assert e.hf == pytest.approx(hf, rel=1e-8)


def test_equal_to_statsmodels(rng):
    y = correlated(rng, 24, 2, 3)
    table = long(y)
    theirs = AnovaRM(table, "y", "who", within=["first", "second"]).fit().anova_table.loc[["first", "second", "first:second"]]
    effects = anova(y).effects
    np.testing.assert_allclose([effect.F for effect in effects], theirs["F Value"], rtol=1e-10)
    np.testing.assert_allclose([effect.p for effect in effects], theirs["Pr > F"], rtol=1e-10)


def test_first_factor_of_two_levels_is_a_t_test(rng):
    y = correlated(rng, 12, 2, 3)
    means = y.mean(axis=2)
    effect = anova(y).effects[0]
    t = stats.ttest_rel(means[:, 0], means[:, 1])
    assert pytest.approx(t.statistic**2, rel=1e-9) == effect.F
    assert effect.p == pytest.approx(t.pvalue, rel=1e-9)
    assert effect.gg == effect.hf == 1.0


def test_what_is_the_same_in_all_conditions_of_a_subject_does_not_count(rng):
    y = correlated(rng, 8, 2, 3)
    shifted = y + rng.normal(0, 50, (8, 1, 1))
    for one, other in zip(anova(y).effects, anova(shifted).effects, strict=True):
        assert pytest.approx(other.F, rel=1e-7) == one.F
        assert one.gg == pytest.approx(other.gg, rel=1e-7)
        assert one.generalised_eta2 > other.generalised_eta2


def test_sums_of_squares_add_up(rng):
    y = correlated(rng, 6, 3, 3)
    found = anova(y)
    total = sum(e.ss + e.ss_error for e in found.effects) + found.ss_subjects
    assert total == pytest.approx(((y - y.mean()) ** 2).sum(), rel=1e-12)
    table = found.table()
    assert table["effect"].tolist() == ["law", "difficulty", "law x difficulty"]
    with pytest.raises(InputError, match=r"no effect 'speed'; it has law"):
        found.effect("speed")


def test_empty_cells_are_named(rng):
    y = correlated(rng, 5, 2, 3)
    y[3, 1, 2] = np.nan
    with pytest.raises(InputError, match=r"1 is empty: D / tolerant / hard"):
        anova(y, levels=(["plain", "tolerant"], ["easy", "so-so", "hard"]), subjects=list("ABCDE"))
    y[:] = np.nan
    with pytest.raises(InputError, match=r"30 are empty: .* and 22 more"):
        anova(y)


@pytest.mark.parametrize("shape", [(1, 2, 3), (5, 1, 3), (5, 2, 1), (5, 6)])
def test_too_small_designs_are_refused(rng, shape):
    with pytest.raises(InputError, match=r"at least 2 of each"):
        anova(rng.normal(size=shape))


def test_no_error_to_test_against_is_refused(rng):
    y = np.tile(rng.normal(size=(1, 2, 3)), (5, 1, 1)) + rng.normal(size=(5, 1, 1))
    with pytest.raises(InputError, match=r"same in every subject"):
        anova(y)


# ---- paired comparisons --------------------------------------------------------------------------------------------------


def test_paired_equal_to_pingouin(rng):
    x, y = rng.normal(size=(2, 15))
    y += 0.4 * x
    found = compare_pairs(x, y)
    theirs = pg.ttest(x, y, paired=True).iloc[0]
    low, high = next(v for name, v in theirs.items() if name.startswith("CI95"))
    np.testing.assert_allclose([found.t, found.df, found.p], [theirs["T"], theirs["dof"], theirs["p_val"]], rtol=1e-8)
    np.testing.assert_allclose([found.low, found.high], [low, high], atol=0.006)
    by_rank = pg.wilcoxon(x, y).iloc[0]
    assert found.wilcoxon == pytest.approx(by_rank["p_val"], rel=1e-8)
    assert found.rank_biserial == pytest.approx(by_rank["RBC"], rel=1e-8)


@pytest.mark.parametrize("ties", [False, True])
def test_wilcoxon_by_enumeration(rng, ties):
    """All 2^12 signs; with ties (and pairs without a difference, which are left out) as without."""
    d = rng.normal(0.4, 1.0, 12)
    if ties:
        d = np.r_[np.round(2 * d) / 2 + 0.5 * (np.round(2 * d) == 0), 0.0, 0.0]
    ranks = stats.rankdata(np.abs(d[d != 0]))
    sums = np.array([ranks @ np.array(signs) for signs in product((-1, 1), repeat=12)])
    expected = np.mean(np.abs(sums) >= abs(ranks @ np.sign(d[d != 0])) - 1e-9)
    found = compare_pairs(d, np.zeros(len(d)))
    d = d[d != 0]
    assert found.wilcoxon == pytest.approx(expected, rel=1e-9)
    assert found.rank_biserial == pytest.approx(ranks @ np.sign(d) / ranks.sum())


def test_wilcoxon_with_ties_at_twenty_pairs():
    """Twenty differences of 1 and 2: by counting how many of the ones and of the twos are positive."""
    d = np.r_[np.ones(9), -np.ones(3), 2 * np.ones(6), -2 * np.ones(2)]
    one, two = 6.5, 16.5  # mean ranks of 12 ones and of 8 twos
    sums = one * np.arange(13)[:, None] + two * np.arange(9)
    chance = stats.binom.pmf(np.arange(13), 12, 0.5)[:, None] * stats.binom.pmf(np.arange(9), 8, 0.5)
    middle, seen = 105.0, 9 * one + 6 * two
    expected = chance[np.abs(sums - middle) >= abs(seen - middle) - 1e-9].sum()
    assert compare_pairs(d, np.zeros(20)).wilcoxon == pytest.approx(expected, rel=1e-12)


def noncentral_t_below(t, df, z):
    """P(T <= t) by integration over the estimated standard deviation."""
    value, _ = integrate.quad(
        lambda s: stats.norm.cdf(t * s - z) * stats.chi.pdf(s * np.sqrt(df), df) * np.sqrt(df), 0, 12, limit=400, epsabs=1e-12
    )
    return value


@pytest.mark.parametrize(("n", "shift"), [(6, 0.0), (10, 0.7), (24, -3.0)])
def test_interval_of_dz_is_that_of_the_noncentral_t(rng, n, shift):
    found = compare_pairs(rng.normal(shift, 1.0, n), np.zeros(n), confidence=0.9)
    assert found.dz == pytest.approx(found.t / np.sqrt(n))
    assert noncentral_t_below(found.t, n - 1, found.dz_low * np.sqrt(n)) == pytest.approx(0.95, abs=1e-6)
    assert noncentral_t_below(found.t, n - 1, found.dz_high * np.sqrt(n)) == pytest.approx(0.05, abs=1e-6)


@pytest.mark.parametrize("size", [1.0, 30.0, 1e4])
def test_effects_of_any_size_have_an_interval(rng, size):
    for n in (2, 3, 24):
        found = compare_pairs(size * (1 + 0.1 * rng.random(n)), np.zeros(n))
        assert found.dz_low < found.dz < found.dz_high


def test_pairs_with_nothing_in_them(rng):
    x = rng.normal(size=6)
    same = compare_pairs(x, x)
    assert (same.n, same.difference) == (6, 0.0)
    assert np.isnan([same.t, same.p, same.dz, same.wilcoxon]).all()
    alone = compare_pairs([1.0, np.nan], [0.5, 2.0])
    assert (alone.n, alone.difference) == (1, 0.5)
    assert np.isnan(alone.p)
    assert compare_pairs([np.nan], [1.0]).n == 0
    with pytest.raises(InputError, match=r"same length"):
        compare_pairs([1.0], [1.0, 2.0])
    with pytest.raises(InputError, match=r"confidence is 95"):
        compare_pairs(x, x + 1, confidence=95)


def test_holm_equal_to_pingouin(rng):
    p = rng.random(7) ** 3
    np.testing.assert_allclose(correct_by_holm(p), pg.multicomp(p, method="holm")[1], rtol=1e-12)
    with_nan = np.insert(p, 2, np.nan)
    np.testing.assert_allclose(np.delete(correct_by_holm(with_nan), 2), correct_by_holm(p))
    assert np.isnan(correct_by_holm(with_nan)[2])
    assert np.isnan(correct_by_holm([np.nan])).all()


# ---- correlations --------------------------------------------------------------------------------------------------------


def test_correlation_equal_to_pingouin(rng):
    x = rng.normal(size=20)
    y = 0.6 * x + rng.normal(size=20)
    found = correlate(x, y)
    row = pg.corr(x, y).iloc[0]
    assert found.r == pytest.approx(row["r"], rel=1e-8)
    assert found.p == pytest.approx(row["p_val"], rel=1e-6)
    z = np.arctanh(found.r) + np.array([-1, 1]) * stats.norm.ppf(0.975) / np.sqrt(17)
    np.testing.assert_allclose([found.low, found.high], np.tanh(z), rtol=1e-9)
    assert found.spearman == pytest.approx(pg.corr(x, y, method="spearman").iloc[0]["r"], rel=1e-8)


def test_correlation_lists_what_it_leaves_out(rng):
    x, y = rng.normal(size=(2, 9))
    x[4], y[7] = np.nan, np.inf
    found = correlate(x, y, ("a", "b"), labels=[f"task {k + 1}" for k in range(9)])
    assert (found.n, found.left_out) == (7, ("task 5", "task 8"))
    keep = [k for k in range(9) if k not in (4, 7)]
    assert found.r == pytest.approx(np.corrcoef(x[keep], y[keep])[0, 1])
    assert np.isnan(correlate(np.ones(5), rng.normal(size=5)).r)
    assert np.isnan(correlate([1.0, 2.0], [1.0, 2.0]).r)
    with pytest.raises(InputError, match=r"same length"):
        correlate(x, y[:3])


# ---- power ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("dz", [0.2, 0.8, 2.5])
def test_power_of_t_by_integration(dz):
    for n in (3, 8, 40):
        edge, size = stats.t.isf(0.025, n - 1), dz * np.sqrt(n)
        expected = 1 - noncentral_t_below(edge, n - 1, size) + noncentral_t_below(-edge, n - 1, size)
        assert power.t_test_power(dz, n, 0.05) == pytest.approx(expected, abs=1e-7)
    found = subjects_for_t(dz, 0.9)
    assert power.t_test_power(dz, found) >= 0.9 > power.t_test_power(dz, found - 1)
    assert subjects_for_t(-dz, 0.9) == found


def test_power_of_t_equal_to_statsmodels():
    for dz, n in [(0.2, 40), (0.8, 8), (1.5, 4)]:  # it gives NaN where the power is nearly 1
        expected = TTestPower().power(dz, n, 0.05, alternative="two-sided")
        assert power.t_test_power(dz, n, 0.05) == pytest.approx(expected, rel=1e-7)


def test_power_of_f_with_one_degree_of_freedom_is_that_of_t():
    for dz, n in [(0.5, 10), (1.5, 5), (0.3, 80)]:
        assert power.f_test_power(dz**2, 1, n) == pytest.approx(power.t_test_power(dz, n), rel=1e-7)
    assert subjects_for_f(0.8**2, 1) == subjects_for_t(0.8)
    assert subjects_for_t(0.0) is None
    assert subjects_for_t(float("nan")) is None
    assert subjects_for_f(1e-9, 2) is None
    with pytest.raises(InputError, match=r"0 < limit < power < 1"):
        subjects_for_t(1.0, 0.8, 0.9)


def test_power_of_f_by_experiments(rng):
    """Many experiments with normal spherical data: the share with a significant interaction."""
    n, effect = 6, np.array([[0.5, 0.0, -0.5], [-0.5, 0.0, 0.5]])
    y = rng.normal(size=(20_000, n, 2, 3)) + effect
    sums = power.sums_of_squares(y)
    df, df_error = power.degrees_of_freedom(n, 2, 3)
    f = (sums.effects / df) / (sums.errors / df_error)
    share = (f[:, 2] > stats.f.isf(0.05, 2, 2 * (n - 1))).mean()
    assert share == pytest.approx(power.f_test_power(float((effect**2).sum()), 2, n), abs=0.015)


def test_lower_end_of_the_noncentrality():
    for f, df, df_error in [(188.0, 1, 23), (5.0, 2, 46)]:
        low = power.lower_noncentrality_limit(f, df, df_error, 0.9)
        assert 0 < low < f * df
        assert stats.ncf.cdf(f, df, df_error, low) == pytest.approx(0.95, abs=1e-8)
    assert power.lower_noncentrality_limit(0.5, 2, 46) == 0.0


def test_subsets_of_all_subjects_are_the_experiment(rng):
    y = correlated(rng, 9, 2, 3)
    significant = [e.p < 0.05 for e in anova(y).effects]
    assert power.estimate_power(y, 9, draws=50).tolist() == [float(s) for s in significant]
    few = power.estimate_power(y, 4, draws=300, seed=5)
    assert (few == power.estimate_power(y, 4, draws=300, seed=5)).all()
    assert ((few >= 0) & (few <= 1)).all()
