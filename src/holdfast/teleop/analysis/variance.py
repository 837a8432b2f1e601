"""Within-subjects analysis of variance with two factors: effects, effect sizes and corrections for sphericity.

Source: Goel et al. 2003, section 7, for the design; Greenhouse and Geisser 1959; Huynh and Feldt 1976; Olejnik and Algina 2003.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass, fields
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from holdfast.errors import InputError

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]

_NOTHING = 1e-24  # of the whole variation, squared rounding: below it there is no error to compare with


@dataclass(frozen=True, kw_only=True)
class Effect:
    """One effect of a within-subjects analysis of variance.

    Attributes:
        name: Of the factor, or ``first x second`` for the interaction.
        F: Mean square of the effect divided by that of its error.
        df: Degrees of freedom of the effect.
        df_error: Of its error.
        p: Probability of such an F or a larger one if there is no effect, sphericity assumed.
        gg: Epsilon of Greenhouse and Geisser: 1 if spherical, ``1 / df`` at worst.
        p_gg: p with both degrees of freedom multiplied by ``gg``.
        hf: Epsilon of Huynh and Feldt, at most 1.
        p_hf: p with both degrees of freedom multiplied by ``hf``.
        partial_eta2: Share of the effect in the variation of effect and error.
        generalised_eta2: Share of the effect in the variation of effect, subjects and all errors.
        ss: Sum of squares of the effect.
        ss_error: Of its error.
    """

    name: str
    F: float
    df: int
    df_error: int
    p: float
    gg: float
    p_gg: float
    hf: float
    p_hf: float
    partial_eta2: float
    generalised_eta2: float
    ss: float
    ss_error: float

    def __str__(self) -> str:
        return f"{self.name}: F({self.df}, {self.df_error}) = {self.F:.2f}, p = {self.p:.2g}"


@dataclass(frozen=True)
class Anova:
    """A within-subjects analysis of variance with two factors.

    Attributes:
        effects: Of the first factor, of the second, and of their interaction.
        subjects: How many.
        ss_subjects: Sum of squares between subjects.
    """

    effects: tuple[Effect, Effect, Effect]
    subjects: int
    ss_subjects: float

    def effect(self, name: str) -> Effect:
        """By name.

        Raises:
            InputError: There is none of that name.
        """
        for e in self.effects:
            if e.name == name:
                return e
        raise InputError(f"the ANOVA has no effect '{name}'; it has {', '.join(e.name for e in self.effects)}")

    def table(self) -> DataFrame:
        """A row for each effect, with the columns of :class:`holdfast.teleop.analysis.Effect`; the name is ``effect``."""
        from pandas import DataFrame

        columns = ["effect", *(f.name for f in fields(Effect)[1:])]
        return DataFrame([astuple(e) for e in self.effects], columns=columns)


@dataclass(frozen=True)
class Squares:
    """Sums of squares of a two-factor within-subjects design, or of many at once.

    Attributes:
        effects: (..., 3) of the factors and the interaction.
        errors: (..., 3) of their interactions with subjects.
        subjects: (...) between subjects.
    """

    effects: Array
    errors: Array
    subjects: Array


def squares(y: Array) -> Squares:
    """Sums of squares of (..., n, A, B) values of n subjects, A levels of the first factor and B of the second."""
    n, a, b = y.shape[-3:]
    whole = y.mean(axis=(-3, -2, -1), keepdims=True)
    s = y.mean(axis=(-2, -1), keepdims=True)
    first, second, both = (y.mean(axis=k, keepdims=True) for k in ((-3, -1), (-3, -2), -3))
    s_first, s_second = y.mean(axis=-1, keepdims=True), y.mean(axis=-2, keepdims=True)

    def total(weight: int, part: Array) -> Array:
        return np.asarray(weight * np.square(part).sum(axis=(-3, -2, -1)))

    effects = [
        total(n * b, first - whole),
        total(n * a, second - whole),
        total(n, both - first - second + whole),
    ]
    errors = [
        total(b, s_first - s - first + whole),
        total(a, s_second - s - second + whole),
        total(1, y - s_first - s_second - both + s + first + second - whole),
    ]
    return Squares(np.stack(effects, axis=-1), np.stack(errors, axis=-1), total(a * b, s - whole))


def freedom(subjects: int, first: int, second: int) -> tuple[Array, Array]:
    """(3,) degrees of freedom of factors and interaction, and (3,) of their errors."""
    df = np.array([first - 1, second - 1, (first - 1) * (second - 1)], dtype=np.float64)
    return df, df * (subjects - 1)


def anova(
    values: ArrayLike,
    factors: tuple[str, str] = ("law", "difficulty"),
    levels: tuple[Sequence[str], Sequence[str]] | None = None,
    *,
    subjects: Sequence[str] | None = None,
) -> Anova:
    """Within-subjects analysis of variance with two factors, every subject in every cell.

    F and p are those of statsmodels' ``AnovaRM``; the corrections and effect sizes, which it does not have, are ours.

    Args:
        values: (n, A, B) one value of each of n subjects for A levels of the first factor and B of the second.
        factors: Their names.
        levels: Names of the levels, for messages.
        subjects: Names of the subjects, for messages.

    Raises:
        InputError: Fewer than two subjects or levels, empty cells (the message names them), or values whose effects differ
            between no subjects, so that there is no error to test against.

    Source: Goel et al. 2003, section 7.
    """
    from scipy import stats

    y = np.asarray(values, dtype=np.float64)
    _check(y, factors, levels, subjects)
    n, a, b = y.shape
    sums = squares(y)
    df, df_error = freedom(n, a, b)
    names = (*factors, f"{factors[0]} x {factors[1]}")
    scale = float(sums.effects.sum() + sums.errors.sum() + sums.subjects) + a * b * n * float(y.mean()) ** 2
    for name, error in zip(names, sums.errors.tolist(), strict=True):
        if error <= _NOTHING * scale:
            raise InputError(f"the effect of {name} is the same in every subject: there is no error to test it against")
    f, p = _statsmodels(y)
    found = []
    for k, name in enumerate(names):
        gg, hf = epsilons(_contrasted(y, k))
        ss, ss_error = float(sums.effects[k]), float(sums.errors[k])
        corrected = [float(stats.f.sf(f[k], e * df[k], e * df_error[k])) for e in (gg, hf)]
        found.append(
            Effect(
                name=name,
                F=f[k],
                df=int(df[k]),
                df_error=int(df_error[k]),
                p=p[k],
                gg=gg,
                p_gg=corrected[0],
                hf=hf,
                p_hf=corrected[1],
                partial_eta2=ss / (ss + ss_error),
                generalised_eta2=ss / (ss + float(sums.subjects + sums.errors.sum())),
                ss=ss,
                ss_error=ss_error,
            )
        )
    return Anova((found[0], found[1], found[2]), n, float(sums.subjects))


def epsilons(contrasts: Array) -> tuple[float, float]:
    """Epsilons of Greenhouse and Geisser and of Huynh and Feldt.

    Args:
        contrasts: (n, k) values of k orthonormal contrasts of n subjects.
    """
    n, k = contrasts.shape
    if k == 1:
        return 1.0, 1.0
    covariance = np.cov(contrasts, rowvar=False)
    gg = float(np.trace(covariance) ** 2 / (k * np.sum(covariance**2)))
    left = k * (n - 1 - k * gg)
    return gg, min(1.0, (n * k * gg - 2) / left) if left > 0 else 1.0


def _contrasted(y: Array, effect: int) -> Array:
    """(n, df) of each subject the orthonormal contrasts of an effect: of the first factor, the second, or both."""
    n, a, b = y.shape
    first = _orthonormal(a) if effect in (0, 2) else np.full((a, 1), 1 / np.sqrt(a))
    second = _orthonormal(b) if effect in (1, 2) else np.full((b, 1), 1 / np.sqrt(b))
    return np.asarray(np.einsum("nab,ai,bj->nij", y, first, second).reshape(n, -1))


def _orthonormal(levels: int) -> Array:
    """(levels, levels - 1) orthonormal contrasts."""
    from scipy.linalg import helmert

    return np.asarray(helmert(levels).T)


def _statsmodels(y: Array) -> tuple[list[float], list[float]]:
    from pandas import DataFrame
    from statsmodels.stats.anova import AnovaRM

    n, a, b = y.shape
    subject, first, second = (k.ravel() for k in np.indices((n, a, b)))
    # Its search for the subject's name in those of the effects takes parts of words: the names are ours, not the caller's.
    table = DataFrame({"value": y.ravel(), "subject": subject, "one": first, "two": second})
    found = AnovaRM(table, "value", "subject", within=["one", "two"]).fit().anova_table
    rows = ["one", "two", "one:two"]
    return [float(x) for x in found.loc[rows, "F Value"]], [float(x) for x in found.loc[rows, "Pr > F"]]


def _check(
    y: Array,
    factors: tuple[str, str],
    levels: tuple[Sequence[str], Sequence[str]] | None,
    subjects: Sequence[str] | None,
) -> None:
    if y.ndim != 3 or y.shape[0] < 2 or min(y.shape[1:]) < 2:
        raise InputError(
            f"the values have shape {y.shape}; an ANOVA needs (subjects, levels of {factors[0]}, levels of "
            f"{factors[1]}), at least "
            "2 of each"
        )
    n, a, b = y.shape
    if not np.isfinite(y).all():
        who = [str(k + 1) for k in range(n)] if subjects is None else list(subjects)
        one, two = ([str(k + 1) for k in range(a)], [str(k + 1) for k in range(b)]) if levels is None else levels
        cells = [f"{who[s]} / {one[i]} / {two[j]}" for s, i, j in np.argwhere(~np.isfinite(y))]
        raise InputError(f"the ANOVA needs every subject in every cell, and {empty_cells(cells)}")


def empty_cells(cells: Sequence[str], most: int = 8) -> str:
    """``2 are empty: a, b``, with so many named at most."""
    more = f" and {len(cells) - most} more" if len(cells) > most else ""
    return f"{len(cells)} {'is' if len(cells) == 1 else 'are'} empty: {', '.join(cells[:most])}{more}"
