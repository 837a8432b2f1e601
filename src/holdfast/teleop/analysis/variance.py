"""Within-subjects analysis of variance with two factors: effects, effect sizes and corrections for sphericity.

Source: Goel et al. 2003, section 7, for the design; Greenhouse and Geisser 1959; Huynh and Feldt 1976; Olejnik and Algina 2003.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass, fields
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from holdfast.core.errors import InputError
from holdfast.core.typing import FloatArray

if TYPE_CHECKING:
    from pandas import DataFrame


_ERROR_TOLERANCE = 1e-24  # of the total variation, squared rounding: below it there is no error to test against


@dataclass(frozen=True, kw_only=True)
class Effect:
    """Effect of a within-subjects analysis of variance.

    Attributes:
        name: Name of the factor, or ``first x second`` for the interaction.
        F: Mean square of the effect divided by that of its error.
        df: Degrees of freedom of the effect.
        df_error: Degrees of freedom of the error.
        p: Probability of this F or a larger one without an effect, under sphericity.
        gg: Epsilon of Greenhouse and Geisser: 1 under sphericity, ``1 / df`` at worst.
        p_gg: p-value with both degrees of freedom multiplied by ``gg``.
        hf: Epsilon of Huynh and Feldt, at most 1.
        p_hf: p-value with both degrees of freedom multiplied by ``hf``.
        partial_eta2: Fraction of the effect in the variation of effect and error.
        generalised_eta2: Fraction of the effect in the variation of effect, subjects and all errors.
        ss: Sum of squares of the effect.
        ss_error: Sum of squares of the error.
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
    """Within-subjects analysis of variance with two factors.

    Attributes:
        effects: Effects of the first factor, of the second, and of their interaction.
        subjects: Number of subjects.
        ss_subjects: Sum of squares between subjects.
    """

    effects: tuple[Effect, Effect, Effect]
    subjects: int
    ss_subjects: float

    def effect(self, name: str) -> Effect:
        """Return the effect with the name ``name``.

        Raises:
            InputError: There is no effect of this name.
        """
        for effect in self.effects:
            if effect.name == name:
                return effect
        raise InputError(f"the ANOVA has no effect '{name}'; it has {', '.join(effect.name for effect in self.effects)}")

    def table(self) -> DataFrame:
        """Return a table with a row for each effect and the fields of an ``Effect`` as columns; the name is in ``effect``."""
        from pandas import DataFrame

        columns = ["effect", *(field.name for field in fields(Effect)[1:])]
        return DataFrame([astuple(effect) for effect in self.effects], columns=columns)


@dataclass(frozen=True)
class SumsOfSquares:
    """Sums of squares of one two-factor within-subjects design, or of many.

    Attributes:
        effects: (..., 3) sums of squares of the factors and the interaction.
        errors: (..., 3) sums of squares of their interactions with subjects.
        subjects: (...) sums of squares between subjects.
    """

    effects: FloatArray
    errors: FloatArray
    subjects: FloatArray


def sums_of_squares(y: FloatArray) -> SumsOfSquares:
    """Return the sums of squares of (..., n, A, B) values of n subjects, A levels of the first factor and B of the second."""
    n, a, b = y.shape[-3:]
    grand_mean = y.mean(axis=(-3, -2, -1), keepdims=True)
    subject_mean = y.mean(axis=(-2, -1), keepdims=True)
    first_mean, second_mean, cell_mean = (y.mean(axis=axes, keepdims=True) for axes in ((-3, -1), (-3, -2), -3))
    subject_first_mean, subject_second_mean = y.mean(axis=-1, keepdims=True), y.mean(axis=-2, keepdims=True)

    def weighted_total(weight: int, deviations: FloatArray) -> FloatArray:
        return np.asarray(weight * np.square(deviations).sum(axis=(-3, -2, -1)))

    effects = [
        weighted_total(n * b, first_mean - grand_mean),
        weighted_total(n * a, second_mean - grand_mean),
        weighted_total(n, cell_mean - first_mean - second_mean + grand_mean),
    ]
    errors = [
        weighted_total(b, subject_first_mean - subject_mean - first_mean + grand_mean),
        weighted_total(a, subject_second_mean - subject_mean - second_mean + grand_mean),
        weighted_total(
            1, y - subject_first_mean - subject_second_mean - cell_mean + subject_mean + first_mean + second_mean - grand_mean
        ),
    ]
    return SumsOfSquares(
        np.stack(effects, axis=-1), np.stack(errors, axis=-1), weighted_total(a * b, subject_mean - grand_mean)
    )


def degrees_of_freedom(subjects: int, first: int, second: int) -> tuple[FloatArray, FloatArray]:
    """Return the degrees of freedom (3,) of the factors and the interaction, and (3,) of their errors."""
    df = np.array([first - 1, second - 1, (first - 1) * (second - 1)], dtype=np.float64)
    return df, df * (subjects - 1)


def anova(
    values: ArrayLike,
    factors: tuple[str, str] = ("law", "difficulty"),
    levels: tuple[Sequence[str], Sequence[str]] | None = None,
    *,
    subjects: Sequence[str] | None = None,
) -> Anova:
    """Compute the within-subjects analysis of variance with two factors, every subject in every cell.

    Args:
        values: (n, A, B) one value of each of n subjects for A levels of the first factor and B of the second.
        factors: Names of the factors.
        levels: Names of the levels, for messages.
        subjects: Names of the subjects, for messages.

    Raises:
        InputError: There are fewer than two subjects or levels, cells are empty (the message names them), or an effect is equal
            in all subjects, so that there is no error to test against.

    Source: Goel et al. 2003, section 7.
    """
    from scipy import stats

    y = np.asarray(values, dtype=np.float64)
    _check_values(y, factors, levels, subjects)
    n, a, b = y.shape
    sums = sums_of_squares(y)
    df, df_error = degrees_of_freedom(n, a, b)
    names = (*factors, f"{factors[0]} x {factors[1]}")
    scale = float(sums.effects.sum() + sums.errors.sum() + sums.subjects) + a * b * n * float(y.mean()) ** 2
    for name, error in zip(names, sums.errors.tolist(), strict=True):
        if error <= _ERROR_TOLERANCE * scale:
            raise InputError(f"the effect of {name} is the same in every subject, so there is no error to test it against")
    f_values = (sums.effects / df) / (sums.errors / df_error)
    p_values = np.asarray(stats.f.sf(f_values, df, df_error))
    effects = []
    for index, name in enumerate(names):
        gg, hf = sphericity_epsilons(_compute_effect_contrasts(y, index))
        sum_effect, sum_error = float(sums.effects[index]), float(sums.errors[index])
        corrected = [float(stats.f.sf(f_values[index], epsilon * df[index], epsilon * df_error[index])) for epsilon in (gg, hf)]
        effects.append(
            Effect(
                name=name,
                F=float(f_values[index]),
                df=int(df[index]),
                df_error=int(df_error[index]),
                p=float(p_values[index]),
                gg=gg,
                p_gg=corrected[0],
                hf=hf,
                p_hf=corrected[1],
                partial_eta2=sum_effect / (sum_effect + sum_error),
                generalised_eta2=sum_effect / (sum_effect + float(sums.subjects + sums.errors.sum())),
                ss=sum_effect,
                ss_error=sum_error,
            )
        )
    return Anova((effects[0], effects[1], effects[2]), n, float(sums.subjects))


def sphericity_epsilons(contrasts: FloatArray) -> tuple[float, float]:
    """Return the epsilons of Greenhouse and Geisser and of Huynh and Feldt.

    Args:
        contrasts: (n, k) values of k orthonormal contrasts of n subjects.
    """
    n, contrast_count = contrasts.shape
    if contrast_count == 1:
        return 1.0, 1.0
    covariance = np.cov(contrasts, rowvar=False)
    gg = float(np.trace(covariance) ** 2 / (contrast_count * np.sum(covariance**2)))
    denominator = contrast_count * (n - 1 - contrast_count * gg)
    return gg, min(1.0, (n * contrast_count * gg - 2) / denominator) if denominator > 0 else 1.0


def _compute_effect_contrasts(y: FloatArray, effect: int) -> FloatArray:
    """Return the orthonormal contrasts (n, df) of each subject for an effect: the first factor, the second, or both."""
    n, a, b = y.shape
    first_contrasts = _orthonormal_contrasts(a) if effect in (0, 2) else np.full((a, 1), 1 / np.sqrt(a))
    second_contrasts = _orthonormal_contrasts(b) if effect in (1, 2) else np.full((b, 1), 1 / np.sqrt(b))
    return np.asarray(np.einsum("nab,ai,bj->nij", y, first_contrasts, second_contrasts).reshape(n, -1))


def _orthonormal_contrasts(levels: int) -> FloatArray:
    """Return the (levels, levels - 1) orthonormal contrasts."""
    from scipy.linalg import helmert

    return np.asarray(helmert(levels).T)


def _check_values(
    y: FloatArray, factors: tuple[str, str], levels: tuple[Sequence[str], Sequence[str]] | None, subjects: Sequence[str] | None
) -> None:
    if y.ndim != 3 or y.shape[0] < 2 or min(y.shape[1:]) < 2:
        raise InputError(
            f"the values have shape {y.shape}; an ANOVA needs (subjects, levels of {factors[0]}, levels of {factors[1]}), at "
            "least 2 of each"
        )
    n, a, b = y.shape
    if not np.isfinite(y).all():
        subject_names = [str(index + 1) for index in range(n)] if subjects is None else list(subjects)
        first_levels, second_levels = (
            ([str(index + 1) for index in range(a)], [str(index + 1) for index in range(b)]) if levels is None else levels
        )
        cells = [
            f"{subject_names[subject]} / {first_levels[first]} / {second_levels[second]}"
            for subject, first, second in np.argwhere(~np.isfinite(y))
        ]
        raise InputError(f"the ANOVA needs every subject in every cell, and {describe_empty_cells(cells)}")


def describe_empty_cells(cells: Sequence[str], max_names: int = 8) -> str:
    """Return ``2 are empty: a, b``, with at most ``max_names`` names."""
    remainder = f" and {len(cells) - max_names} more" if len(cells) > max_names else ""
    return f"{len(cells)} {'is' if len(cells) == 1 else 'are'} empty: {', '.join(cells[:max_names])}{remainder}"
