"""The tables of an analysis, as data frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.teleop.analysis.comparisons import holm, paired
from holdfast.teleop.analysis.correlations import Correlation
from holdfast.teleop.analysis.groups import Cells, Groups
from holdfast.teleop.analysis.observations import CAUSES, NAMES, Observed
from holdfast.teleop.trials.performance import MEASURES, RECORDED

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]

_ROUNDING = 1e-9


def trials(observed: Observed, grouped: Groups) -> DataFrame:
    """A row for each trial that there should be: its measures, its CPM, and why there is none."""
    from pandas import DataFrame

    p, t, s = (k.ravel() for k in np.indices(observed.cause.shape))
    columns: dict[str, Any] = {
        "subject": [observed.subjects[k] for k in p],
        "task": [observed.tasks[k] for k in t],
        "difficulty": [grouped.names[grouped.of_task[k]] for k in t],
        "scenario": [observed.conditions[k].scenario for k in s],
        "law": [observed.conditions[k].law for k in s],
        "failed": [int(observed.conditions[k].failed) for k in s],
        "cause": [str(c) for c in observed.cause.ravel()],
        **{name: observed.measures[..., k].ravel() for k, name in enumerate(NAMES[:RECORDED])},
        NAMES[RECORDED]: observed.ratings.ravel(),
        "cpm": observed.cpm.ravel(),
    }
    return DataFrame(columns)


def means(cells: Cells) -> DataFrame:
    """Of each law in each group of tasks: mean, standard deviation and standard error over subjects."""
    from pandas import DataFrame

    out = []
    for a, b in np.ndindex(len(cells.laws), len(cells.groups)):
        y = cells.values[:, a, b]
        y = y[np.isfinite(y)]
        spread = float(y.std(ddof=1)) if len(y) > 1 else float("nan")
        mean = float(y.mean()) if len(y) else float("nan")
        error = spread / np.sqrt(max(len(y), 1))
        out.append((cells.laws[a], cells.groups[b], len(y), mean, spread, error, int(cells.tasks[:, a, b].sum())))
    return DataFrame(out, columns=["law", "difficulty", "subjects", "mean", "sd", "se", "trials"])


def comparisons(cells: Cells, confidence: float) -> DataFrame:
    """The laws in pairs, within each group of tasks; Holm's correction is over all rows."""
    from pandas import DataFrame

    out = []
    for i, j in combinations(range(len(cells.laws)), 2):
        for b, group in enumerate(cells.groups):
            found = asdict(paired(cells.values[:, i, b], cells.values[:, j, b], confidence))
            out.append({"difficulty": group, "first": cells.laws[i], "second": cells.laws[j], **found})
    return _with_holm(DataFrame(out))


def by_measure(observed: Observed, conditions: Sequence[int], confidence: float) -> DataFrame:
    """Scenarios in pairs, CPM and each measure, over the tasks that a subject completed in both.

    Holm's correction is over all rows.
    """
    from pandas import DataFrame

    out = []
    everything = np.concatenate([observed.cpm[..., None], observed.measures], axis=-1)
    # Rounding of what is 0, as an error of the healthy pseudoinverse, must not become a significant difference.
    everything[np.abs(everything) < _ROUNDING] = 0.0
    for i, j in combinations(conditions, 2):
        both = np.isfinite(observed.cpm[:, :, i]) & np.isfinite(observed.cpm[:, :, j])
        for k, name in enumerate(("CPM", *NAMES)):
            if k == len(NAMES) and not observed.rated:
                continue
            first, second = (_mean(np.where(both, everything[:, :, c, k], np.nan)) for c in (i, j))
            about, unit = ("combined performance measure", "1") if k == 0 else (MEASURES[k - 1].about, MEASURES[k - 1].unit)
            out.append(
                {
                    "measure": name,
                    "about": about,
                    "unit": unit,
                    "first": observed.conditions[i].law,
                    "second": observed.conditions[j].law,
                    "first_mean": _overall(first),
                    "second_mean": _overall(second),
                    "trials": int(both.sum()),
                    **asdict(paired(first, second, confidence)),
                }
            )
    return _with_holm(DataFrame(out))


def _mean(values: Array) -> Array:
    """(P,) over tasks, of those that there are; NaN where there are none."""
    there = np.isfinite(values)
    count = there.sum(axis=1)
    return np.where(count > 0, np.where(there, values, 0.0).sum(axis=1) / np.maximum(count, 1), np.nan)


def _overall(values: Array) -> float:
    return float(np.nanmean(values)) if np.isfinite(values).any() else float("nan")


def _with_holm(table: DataFrame) -> DataFrame:
    table.insert(table.columns.get_loc("p") + 1, "p_holm", holm(table["p"].to_numpy()))
    return table


def rows(correlations: Sequence[Correlation]) -> DataFrame:
    """A row for each correlation."""
    from pandas import DataFrame

    return DataFrame([{**asdict(c), "left_out": "; ".join(c.left_out)} for c in correlations])


def tasks(observed: Observed, machine: Observed | None, conditions: Sequence[int], grouped: Groups) -> DataFrame:
    """A row for each task, sorted from the easiest: its difficulty, and CPM of operators and computer with the failed arm.

    The median operator of a task is the one whose CPM of the reference scenario is nearest to the median of all.
    """
    from pandas import DataFrame

    middle, felt, reference = observed.middle(), observed.median_rating(), conditions[0]
    number = [c.scenario for c in observed.conditions]
    out = []
    for t in np.lexsort((np.nan_to_num(middle[:, reference], nan=np.inf), grouped.of_task)):
        of = median_operator(observed, int(t), reference)
        row: dict[str, Any] = {
            "task": observed.tasks[t],
            "difficulty": grouped.names[grouped.of_task[t]],
            "anticipated": float("nan") if machine is None else machine.cpm[0, t, reference],
            "actual": middle[t, reference],
            "perceived": felt[t, reference],
            "median_operator": "" if of is None else observed.subjects[of],
        }
        for k in conditions:
            row[f"cpm_{number[k]}"] = middle[t, k]
            row[f"median_operator_cpm_{number[k]}"] = float("nan") if of is None else observed.cpm[of, t, k]
            row[f"computer_cpm_{number[k]}"] = float("nan") if machine is None else machine.cpm[0, t, k]
            row[f"reached_{number[k]}"] = int(np.isfinite(observed.measures[:, t, k, 0]).sum())
        for k in conditions[1:]:
            ratio = f"{number[k]}_{number[reference]}"
            row[f"ratio_{ratio}"] = _ratio(middle[t, k], middle[t, reference])
            row[f"computer_ratio_{ratio}"] = float("nan")
            if machine is not None:
                row[f"computer_ratio_{ratio}"] = _ratio(machine.cpm[0, t, k], machine.cpm[0, t, reference])
        out.append(row)
    return DataFrame(out)


def median_operator(observed: Observed, task: int, reference: int) -> int | None:
    """The subject, by place, whose CPM of a task is nearest to the median of all; None if nobody reached the target."""
    cpm, middle = observed.cpm[:, task, reference], observed.middle()[task, reference]
    if not np.isfinite(cpm).any():
        return None
    if not np.isfinite(middle):
        return int(np.nanargmax(cpm))  # the median one failed: the last who did not
    return int(np.nanargmin(np.abs(cpm - middle)))


def _ratio(one: float, other: float) -> float:
    return float(one / other) if np.isfinite(one) and np.isfinite(other) and other > 0 else float("nan")


def gains(of_tasks: DataFrame, observed: Observed, conditions: Sequence[int], grouped: Groups) -> DataFrame:
    """Operators against computer: in how many tasks of a group another law than the reference did better, for whom."""
    from pandas import DataFrame

    out = []
    reference = observed.conditions[conditions[0]]
    for k in conditions[1:]:
        c = observed.conditions[k]
        name = f"ratio_{c.scenario}_{reference.scenario}"
        for group in (*grouped.names, "all"):
            mine = of_tasks if group == "all" else of_tasks[of_tasks["difficulty"] == group]
            ours, its = (mine[x].to_numpy(dtype=np.float64) for x in (name, f"computer_{name}"))
            both = np.isfinite(ours) & np.isfinite(its)
            ours, its = ours[both], its[both]
            out.append(
                {
                    "law": c.law,
                    "against": reference.law,
                    "difficulty": group,
                    "tasks": int(both.sum()),
                    "operators_gain": int((ours < 1).sum()),
                    "computer_gains": int((its < 1).sum()),
                    "same_direction": int(((ours < 1) == (its < 1)).sum()),
                    "operators_median_ratio": float(np.median(ours)) if len(ours) else float("nan"),
                    "computer_median_ratio": float(np.median(its)) if len(its) else float("nan"),
                }
            )
    return DataFrame(out)


def measures(observed: Observed, machine: Observed | None) -> DataFrame:
    """The distribution of CPM and each measure in each scenario, over all trials that reached the target."""
    from pandas import DataFrame

    out = []
    for s, c in enumerate(observed.conditions):
        for k, name in enumerate(("CPM", *NAMES)):
            values = _values(observed, s, k)
            its = np.empty(0) if machine is None else _values(machine, s, k)
            five = np.quantile(values, [0, 0.25, 0.5, 0.75, 1]).tolist() if values.size else [float("nan")] * 5
            out.append(
                {
                    "scenario": c.scenario,
                    "law": c.law,
                    "failed": int(c.failed),
                    "measure": name,
                    "unit": "1" if k == 0 else MEASURES[k - 1].unit,
                    "trials": int(values.size),
                    "mean": float(values.mean()) if values.size else float("nan"),
                    "sd": float(values.std(ddof=1)) if values.size > 1 else float("nan"),
                    **dict(zip(("lowest", "quarter", "median", "three_quarters", "highest"), five, strict=True)),
                    "computer_median": float(np.median(its)) if its.size else float("nan"),
                }
            )
    return DataFrame(out)


def _values(observed: Observed, scenario: int, measure: int) -> Array:
    """CPM (0) or a measure (from 1) of all trials of a scenario that have one."""
    v = observed.cpm if measure == 0 else observed.ratings if measure == len(NAMES) else observed.measures[..., measure - 1]
    chosen = v[:, :, scenario]
    return chosen[np.isfinite(chosen)]


def ends(observed: Observed, machine: Observed | None) -> DataFrame:
    """How the trials of each scenario ended: target reached and rated, or why they have no CPM."""
    from pandas import DataFrame

    out = []
    for s, c in enumerate(observed.conditions):
        cause = observed.cause[:, :, s]
        row: dict[str, Any] = {"scenario": c.scenario, "law": c.law, "failed": int(c.failed), "trials": int(cause.size)}
        row["with_cpm"] = int((cause == "").sum())
        row |= {name.replace(" ", "_"): int((cause == name).sum()) for name in CAUSES}
        if machine is not None:
            row["computer_with_cpm"] = int((machine.cause[:, :, s] == "").sum())
        out.append(row)
    return DataFrame(out)


def normalisers(observed: Observed, machine: Observed | None) -> DataFrame:
    """What each measure was divided by in CPM."""
    from pandas import DataFrame

    columns: dict[str, Any] = {"measure": NAMES, "unit": [m.unit for m in MEASURES]}
    for name, of in (("operators", observed), ("computer", machine)):
        if of is not None:
            columns[name] = np.concatenate([of.normalisers, np.full(len(NAMES) - len(of.normalisers), np.nan)])
    return DataFrame(columns)
