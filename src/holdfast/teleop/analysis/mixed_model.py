"""A linear mixed model of single trials: what can be done when cells are empty."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.errors import InputError
from holdfast.teleop.analysis.observations import Observed

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]

_OPTIMISERS = ("lbfgs", "powell", "nm")


@dataclass(frozen=True, kw_only=True)
class WaldTest:
    """Whether an effect of the mixed model is 0: asymptotic, so a little too sure of itself with few subjects or tasks.

    Attributes:
        name: The effect.
        chi2: Wald's statistic.
        df: Its degrees of freedom.
        p: Probability of such a value or a larger one if there is no effect.
    """

    name: str
    chi2: float
    df: int
    p: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Mixed:
    """A linear mixed model of the CPM of single trials with the failed arm, by restricted maximum likelihood.

    Fixed effects are law, difficulty and their interaction, coded as deviations from the mean; subjects and tasks are crossed
    random intercepts. So it tells of other subjects *and* other tasks, where the ANOVA takes the tasks as they are: difficulty,
    which differs between tasks, is tested far more strictly here.

    Attributes:
        tests: Of law, of difficulty, and of their interaction.
        means: (A, B) estimated cell means, each law at each difficulty.
        mean_errors: (A, B) their standard errors.
        variances: Of subjects, of tasks, and of the rest.
        trials: How many were used.
        converged: The optimiser says that it found the maximum. If not, do not use the numbers.
        optimiser: Which one.
        messages: What it warned of.
    """

    tests: tuple[WaldTest, WaldTest, WaldTest]
    means: Array
    mean_errors: Array
    variances: dict[str, float]
    trials: int
    converged: bool
    optimiser: str
    messages: tuple[str, ...]

    def table(self) -> DataFrame:
        """A row for each effect: effect, chi2, df, p, converged."""
        from pandas import DataFrame

        rows = [(t.name, t.chi2, t.df, t.p, int(self.converged)) for t in self.tests]
        return DataFrame(rows, columns=["effect", "chi2", "df", "p", "converged"])


def mixed(observed: Observed, conditions: list[int], group: NDArray[np.int64]) -> Mixed:
    """Fit the model.

    Args:
        observed: The trials.
        conditions: (A,) positions of the scenarios whose laws are compared.
        group: (T,) difficulty of each task, from 0.

    Raises:
        InputError: No trial at all of a law at a difficulty, or too few trials for the model.
    """
    values = observed.cpm[:, :, conditions]
    p, t, a = np.nonzero(np.isfinite(values))
    y, b = values[p, t, a], group[t]
    levels = (len(conditions), int(group.max()) + 1)
    count = np.zeros(levels, dtype=np.int64)
    np.add.at(count, (a, b), 1)
    if (count == 0).any():
        i, j = np.argwhere(count == 0)[0]
        law = observed.conditions[conditions[i]].law
        raise InputError(f"no subject has a trial with {law} in difficulty group {j + 1}: no model can fill that cell")
    if len(y) <= levels[0] * levels[1] + len(set(p)) + len(set(t)):
        raise InputError(f"{len(y)} trials are too few for a mixed model of {len(set(p))} subjects and {len(set(t))} tasks")
    cells = [(i, j) for i in range(levels[0]) for j in range(levels[1])]
    coded, slices = _coded(np.array(cells), levels)
    of_cell = np.zeros(levels, dtype=np.int64)
    of_cell[tuple(np.array(cells).T)] = np.arange(len(cells))
    result, optimiser, messages = _fit(y, coded[of_cell[a, b]], p, t)
    beta = np.asarray(result.fe_params, dtype=np.float64)
    covariance = np.asarray(result.cov_params(), dtype=np.float64)[: len(beta), : len(beta)]
    tests = [_wald(name, beta[s], covariance[s, s]) for name, s in zip(_EFFECTS, slices, strict=True)]
    rest = float(result.scale)
    random = dict(zip(result.model.exog_vc.names, np.asarray(result.vcomp, dtype=np.float64).tolist(), strict=True))
    return Mixed(
        tests=(tests[0], tests[1], tests[2]),
        means=(coded @ beta).reshape(levels),
        mean_errors=np.sqrt(np.einsum("ki,ij,kj->k", coded, covariance, coded)).reshape(levels),
        variances={"subject": random["subject"], "task": random["task"], "rest": rest},
        trials=len(y),
        converged=bool(result.converged),
        optimiser=optimiser,
        messages=messages,
    )


_EFFECTS = ("law", "difficulty", "law x difficulty")


def _coded(cells: NDArray[np.int64], levels: tuple[int, int]) -> tuple[Array, list[slice]]:
    """(K, A B) deviation-coded columns of cells (K, 2): one, law, difficulty, both; and where the last three are."""
    parts = []
    for k, size in enumerate(levels):
        codes = np.vstack([np.eye(size - 1), -np.ones(size - 1)])
        parts.append(codes[cells[:, k]])
    both = np.einsum("ki,kj->kij", *parts).reshape(len(cells), -1)
    ends = np.cumsum([1, *(x.shape[1] for x in (*parts, both))])
    columns = np.hstack([np.ones((len(cells), 1)), *parts, both])
    return columns, [slice(int(s), int(e)) for s, e in pairwise(ends)]


def _fit(y: Array, x: Array, subject: NDArray[np.int64], task: NDArray[np.int64]) -> tuple[Any, str, tuple[str, ...]]:
    """The fit of the first optimiser that converges; of the last one otherwise."""
    from pandas import DataFrame
    from statsmodels.regression.mixed_linear_model import MixedLM

    columns = [f"x{k}" for k in range(x.shape[1])]
    table = DataFrame(x, columns=columns).assign(y=y, subject=subject, task=task, one=0)
    # Crossed random effects are variance components of one group with everything in it.
    model = MixedLM.from_formula(
        "y ~ 0 + " + " + ".join(columns),
        table,
        groups="one",
        re_formula="0",
        vc_formula={"subject": "0 + C(subject)", "task": "0 + C(task)"},
    )
    result, said = None, []
    for name in _OPTIMISERS:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = model.fit(reml=True, method=[name])
        said += [f"{name}: {' '.join(str(w.message).split())}" for w in caught]
        if result.converged:
            break
    return result, name, tuple(dict.fromkeys(said))


def _wald(name: str, beta: Array, covariance: Array) -> WaldTest:
    from scipy import stats

    chi2 = float(beta @ np.linalg.solve(covariance, beta))
    return WaldTest(name=name, chi2=chi2, df=len(beta), p=float(stats.chi2.sf(chi2, len(beta))))
