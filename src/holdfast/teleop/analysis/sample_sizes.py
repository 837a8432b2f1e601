"""How many subjects would have sufficed, for every test of an analysis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from holdfast.teleop.analysis import power as of
from holdfast.teleop.analysis.groups import Cells
from holdfast.teleop.analysis.variance import Anova

if TYPE_CHECKING:
    from pandas import DataFrame

_CURVE = (2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 48)


def tables(
    cells: Cells, anova: Anova | None, comparisons: DataFrame, limit: float, power: float, confidence: float, seed: int
) -> dict[str, DataFrame]:
    """``power``: a row for each test; ``power_curve``: a row for each effect of the ANOVA and number of subjects.

    t-tests are asked for p below ``limit`` divided by their number, which is what Holm's correction asks of the first.
    """
    from pandas import DataFrame

    out = []
    strict = limit / max(len(comparisons), 1)
    for _, r in comparisons.iterrows():
        least = 0.0 if r["dz_low"] * r["dz_high"] <= 0 else min(abs(r["dz_low"]), abs(r["dz_high"]))
        out.append(
            {
                "test": f"{r['difficulty']}: {r['first']} - {r['second']}",
                "kind": "paired t",
                "subjects": int(r["n"]),
                "p_below": strict,
                "effect": "dz",
                "observed": float(r["dz"]),
                "least": least,
                "sufficient": of.subjects_for_t(float(r["dz"]), power, strict),
                "sufficient_for_least": of.subjects_for_t(least, power, strict),
            }
        )
    if anova is None:
        return {"power": _whole(DataFrame(out))}
    curve = []
    n = anova.subjects
    counts = sorted({*_CURVE, n})
    shares = {m: of.resampled(cells.values, m, limit, seed=seed) for m in counts if m <= n}
    for k, e in enumerate(anova.effects):
        each = e.F * e.df / n
        least = of.least_noncentrality(e.F, e.df, e.df_error, confidence) / n
        out.append(
            {
                "test": e.name,
                "kind": "F",
                "subjects": n,
                "p_below": limit,
                "effect": "noncentrality per subject",
                "observed": each,
                "least": least,
                "sufficient": of.subjects_for_f(each, e.df, power, limit=limit, epsilon=e.gg),
                "sufficient_for_least": of.subjects_for_f(least, e.df, power, limit=limit, epsilon=e.gg),
            }
        )
        for count in counts:
            curve.append(
                {
                    "effect": e.name,
                    "subjects": count,
                    "power": of.f_power(each, e.df, count, limit, e.gg),
                    "power_for_least": of.f_power(least, e.df, count, limit, e.gg),
                    "fraction_of_subsets": float(shares[count][k]) if count <= n else float("nan"),
                }
            )
    return {"power": _whole(DataFrame(out)), "power_curve": DataFrame(curve)}


def _whole(table: DataFrame) -> DataFrame:
    """Numbers of subjects as numbers, NaN for more than are considered."""
    for name in ("sufficient", "sufficient_for_least"):
        table[name] = np.array([np.nan if x is None else float(x) for x in table[name]])
    return table
