"""Linear mixed model of single trials, for an experiment with empty cells."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray
from holdfast.teleop.analysis.observations import TrialTable

if TYPE_CHECKING:
    from pandas import DataFrame


_OPTIMISER_NAMES = ("lbfgs", "powell", "nm")


@dataclass(frozen=True, kw_only=True)
class WaldTest:
    """Wald test that an effect of the mixed model is 0; asymptotic, so its p is slightly too small with few subjects or tasks.

    Attributes:
        name: Name of the effect.
        chi2: Wald statistic.
        df: Degrees of freedom of the effect.
        p: Probability of this statistic or a larger one without an effect.
    """

    name: str
    chi2: float
    df: int
    p: float


@dataclass(frozen=True, eq=False, kw_only=True)
class MixedModel:
    """Linear mixed model of the CPM of single trials with the failed arm, fitted by restricted maximum likelihood.

    Fixed effects are law, difficulty and their interaction, coded as deviations from the mean; subjects and tasks are crossed
    random intercepts. The result therefore generalises to other subjects *and* other tasks, whereas the ANOVA treats the tasks
    as fixed. Difficulty, which differs between tasks, is tested far more strictly here.

    Attributes:
        tests: Tests of law, of difficulty, and of their interaction.
        means: (A, B) estimated cell means, each law at each difficulty.
        mean_errors: (A, B) standard errors of the cell means.
        variances: Variances of subjects, of tasks, and of the residual, by name.
        trials: Number of trials that were used.
        converged: True if the optimiser reports a maximum. If not, do not use the numbers.
        optimiser: Name of the optimiser.
        messages: Warnings of the optimiser.
    """

    tests: tuple[WaldTest, WaldTest, WaldTest]
    means: FloatArray
    mean_errors: FloatArray
    variances: dict[str, float]
    trials: int
    converged: bool
    optimiser: str
    messages: tuple[str, ...]

    def table(self) -> DataFrame:
        """Return a table with one row for each effect: effect, chi2, df, p, converged."""
        from pandas import DataFrame

        rows = [(test.name, test.chi2, test.df, test.p, int(self.converged)) for test in self.tests]
        return DataFrame(rows, columns=["effect", "chi2", "df", "p", "converged"])


def fit_mixed_model(observed: TrialTable, conditions: list[int], group: NDArray[np.int64]) -> MixedModel:
    """Fit the linear mixed model.

    Args:
        observed: Trials.
        conditions: (A,) indices of the scenarios whose laws are compared.
        group: (T,) difficulty of each task, from 0.

    Raises:
        InputError: A law has no trial at a difficulty, or there are too few trials for the model.
    """
    values = observed.cpm[:, :, conditions]
    subjects, tasks, laws = np.nonzero(np.isfinite(values))
    y, groups = values[subjects, tasks, laws], group[tasks]
    levels = (len(conditions), int(group.max()) + 1)
    counts = np.zeros(levels, dtype=np.int64)
    np.add.at(counts, (laws, groups), 1)
    if (counts == 0).any():
        law_level, group_level = np.argwhere(counts == 0)[0]
        law = observed.conditions[conditions[law_level]].law
        raise InputError(
            f"no subject has a trial with {law} in difficulty group {group_level + 1}, so no model can fill that cell"
        )
    if len(y) <= levels[0] * levels[1] + len(set(subjects)) + len(set(tasks)):
        raise InputError(
            f"{len(y)} trials are too few for a mixed model of {len(set(subjects))} subjects and {len(set(tasks))} tasks"
        )
    cells = [(law_level, group_level) for law_level in range(levels[0]) for group_level in range(levels[1])]
    design, effect_columns = _code_deviations(np.array(cells), levels)
    cell_number = np.zeros(levels, dtype=np.int64)
    cell_number[tuple(np.array(cells).T)] = np.arange(len(cells))
    result, optimiser, messages = _fit_with_fallback(y, design[cell_number[laws, groups]], subjects, tasks)
    coefficients = np.asarray(result.fe_params, dtype=np.float64)
    covariance = np.asarray(result.cov_params(), dtype=np.float64)[: len(coefficients), : len(coefficients)]
    tests = [
        _test_coefficients(name, coefficients[columns], covariance[columns, columns])
        for name, columns in zip(_EFFECT_NAMES, effect_columns, strict=True)
    ]
    residual_variance = float(result.scale)
    random_variances = dict(zip(result.model.exog_vc.names, np.asarray(result.vcomp, dtype=np.float64).tolist(), strict=True))
    return MixedModel(
        tests=(tests[0], tests[1], tests[2]),
        means=(design @ coefficients).reshape(levels),
        mean_errors=np.sqrt(np.einsum("ki,ij,kj->k", design, covariance, design)).reshape(levels),
        variances={"subject": random_variances["subject"], "task": random_variances["task"], "rest": residual_variance},
        trials=len(y),
        converged=bool(result.converged),
        optimiser=optimiser,
        messages=messages,
    )


_EFFECT_NAMES = ("law", "difficulty", "law x difficulty")


def _code_deviations(cells: NDArray[np.int64], levels: tuple[int, int]) -> tuple[FloatArray, list[slice]]:
    """Return the (K, A B) deviation-coded columns of cells (K, 2): intercept, law, difficulty, interaction; and the slices of
    the last three.
    """
    factor_codes = []
    for factor, level_count in enumerate(levels):
        codes = np.vstack([np.eye(level_count - 1), -np.ones(level_count - 1)])
        factor_codes.append(codes[cells[:, factor]])
    interaction = np.einsum("ki,kj->kij", *factor_codes).reshape(len(cells), -1)
    boundaries = np.cumsum([1, *(block.shape[1] for block in (*factor_codes, interaction))])
    columns = np.hstack([np.ones((len(cells), 1)), *factor_codes, interaction])
    return columns, [slice(int(start), int(stop)) for start, stop in pairwise(boundaries)]


def _fit_with_fallback(
    y: FloatArray, x: FloatArray, subject: NDArray[np.int64], task: NDArray[np.int64]
) -> tuple[Any, str, tuple[str, ...]]:
    """Return the fit of the first optimiser that converges, or that of the last one."""
    from pandas import DataFrame
    from statsmodels.regression.mixed_linear_model import MixedLM

    columns = [f"x{column}" for column in range(x.shape[1])]
    table = DataFrame(x, columns=columns).assign(y=y, subject=subject, task=task, one=0)
    # Crossed random effects are variance components of a single group that contains all trials.
    model = MixedLM.from_formula(
        "y ~ 0 + " + " + ".join(columns),
        table,
        groups="one",
        re_formula="0",
        vc_formula={"subject": "0 + C(subject)", "task": "0 + C(task)"},
    )
    result, texts = None, []
    for optimiser in _OPTIMISER_NAMES:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = model.fit(reml=True, method=[optimiser])
        texts += [f"{optimiser}: {' '.join(str(warning.message).split())}" for warning in caught]
        if result.converged:
            break
    return result, optimiser, tuple(dict.fromkeys(texts))


def _test_coefficients(name: str, coefficients: FloatArray, covariance: FloatArray) -> WaldTest:
    from scipy import stats

    chi2 = float(coefficients @ np.linalg.solve(covariance, coefficients))
    return WaldTest(name=name, chi2=chi2, df=len(coefficients), p=float(stats.chi2.sf(chi2, len(coefficients))))
