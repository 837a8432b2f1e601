"""Numbers of subjects that suffice for every test of an analysis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from holdfast.teleop.analysis import power as of
from holdfast.teleop.analysis.groups import CellMeans
from holdfast.teleop.analysis.variance import Anova

if TYPE_CHECKING:
    from pandas import DataFrame

_CURVE_SUBJECTS = (2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 48)


def tabulate_sample_sizes(
    cells: CellMeans, anova: Anova | None, comparisons: DataFrame, limit: float, power: float, confidence: float, seed: int
) -> dict[str, DataFrame]:
    """Return the tables ``power``, with a row for each test, and ``power_curve``, with a row for each effect and number.

    The t-tests require p below ``limit`` divided by their number, which Holm's correction requires of the first one.
    """
    from pandas import DataFrame

    power_rows = []
    corrected_limit = limit / max(len(comparisons), 1)
    for _, comparison in comparisons.iterrows():
        least_effect = (
            0.0
            if comparison["dz_low"] * comparison["dz_high"] <= 0
            else min(abs(comparison["dz_low"]), abs(comparison["dz_high"]))
        )
        power_rows.append(
            {
                "test": f"{comparison['difficulty']}: {comparison['first']} - {comparison['second']}",
                "kind": "paired t",
                "subjects": int(comparison["n"]),
                "p_below": corrected_limit,
                "effect": "dz",
                "observed": float(comparison["dz"]),
                "least": least_effect,
                "sufficient": of.subjects_for_t(float(comparison["dz"]), power, corrected_limit),
                "sufficient_for_least": of.subjects_for_t(least_effect, power, corrected_limit),
            }
        )
    if anova is None:
        return {"power": _replace_none_by_nan(DataFrame(power_rows))}
    curve_rows = []
    subjects = anova.subjects
    counts = sorted({*_CURVE_SUBJECTS, subjects})
    fractions = {size: of.estimate_power(cells.values, size, limit, seed=seed) for size in counts if size <= subjects}
    for index, effect in enumerate(anova.effects):
        per_subject = effect.F * effect.df / subjects
        least_effect = of.lower_noncentrality_limit(effect.F, effect.df, effect.df_error, confidence) / subjects
        power_rows.append(
            {
                "test": effect.name,
                "kind": "F",
                "subjects": subjects,
                "p_below": limit,
                "effect": "noncentrality per subject",
                "observed": per_subject,
                "least": least_effect,
                "sufficient": of.subjects_for_f(per_subject, effect.df, power, limit=limit, epsilon=effect.gg),
                "sufficient_for_least": of.subjects_for_f(least_effect, effect.df, power, limit=limit, epsilon=effect.gg),
            }
        )
        for count in counts:
            curve_rows.append(
                {
                    "effect": effect.name,
                    "subjects": count,
                    "power": of.f_test_power(per_subject, effect.df, count, limit, effect.gg),
                    "power_for_least": of.f_test_power(least_effect, effect.df, count, limit, effect.gg),
                    "fraction_of_subsets": float(fractions[count][index]) if count <= subjects else float("nan"),
                }
            )
    return {"power": _replace_none_by_nan(DataFrame(power_rows)), "power_curve": DataFrame(curve_rows)}


def _replace_none_by_nan(table: DataFrame) -> DataFrame:
    """Replace missing numbers of subjects by NaN and convert the rest to floats."""
    for column in ("sufficient", "sufficient_for_least"):
        table[column] = np.array([np.nan if value is None else float(value) for value in table[column]])
    return table
