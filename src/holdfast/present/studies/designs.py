"""A sweep of designs in the report of a study: which number of the arm matters, and which designs no other one beats."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from holdfast.arm.task import Task
from holdfast.arms.serial import from_dict
from holdfast.designs.choice import best_design, farther
from holdfast.designs.search import pareto
from holdfast.indices.index import by_name
from holdfast.indices.own_file import check_digest
from holdfast.present.designs.figures import front_figure, parameters_figure
from holdfast.report import figures
from holdfast.report.page import Block, Cell, Picture, Table, Text
from holdfast.studies.jobs.designs import space_of
from holdfast.studies.results import Swept
from holdfast.words import counted, fixed, number, percent

Array = NDArray[np.float64]

_MOST = 8  # designs of the front in the table


def sentence(s: Swept) -> str:
    """The answer in one sentence."""
    best = best_design(s.guaranteed, s.reach)
    share = _share(s)
    text = (
        f"Of {counted(len(s.values), 'design')} of {s.labels['arm']} the best one guarantees a {_index(s)} of "
        f"{number(float(s.guaranteed[best]))} for {share} of the poses and reaches {s.reach[best]:.3f} m"
    )
    if s.start is not None:
        text += f"; the given arm {number(float(s.guaranteed[s.start]))} and {s.reach[s.start]:.3f} m"
    return f"{text}. {farther(s.guaranteed, s.reach, best)}".rstrip()


def sweep(s: Swept, place: int) -> list[Block]:
    """Figures and tables of a sweep; ``place`` makes their names unique in the page."""
    space = space_of(dict(s.plan))
    factors = np.array([p.shown[0] for p in space.parameters])
    shown = s.values * factors
    names = [f"{p.name}, {p.shown[1]}" for p in space.parameters]
    label = figures.plain(f"guaranteed {_index(s)} ({_share(s)} of the poses)")
    best, front = best_design(s.guaranteed, s.reach), pareto(s.reach, s.guaranteed)
    start = None if s.start is None else (float(s.reach[s.start]), float(s.guaranteed[s.start]))
    figure = front_figure(s.reach, s.guaranteed, front.tolist(), best, start, label, _bound(s))
    text = (
        f"Guaranteed: the worst-case {_index(s)} that {_share(s)} of {s.plan['poses']:,} poses of the region "
        f"({s.labels['region']}) have at least, each at its best configuration; a pose that is not reached counts as 0. Reach: "
        "the largest distance of the tool point from the base within the joint limits."
    )
    by_parameter = parameters_figure(names, shown, s.guaranteed, None if start is None else (shown[s.start], start[1]), label)
    rows: list[list[Cell]] = [
        [p.name, p.shown[1], f"{p.lower * f:.6g} to {p.upper * f:.6g}", *_told(s.values[:, k], s, f)]
        for k, (p, f) in enumerate(zip(space.parameters, factors.tolist(), strict=True))
    ]
    head: list[Cell] = ["Parameter", "unit", "bounds", "rank correlation", "in the best tenth"]
    caption = (
        "Rank correlation (Spearman) of the parameter alone with the guaranteed index: near 1 or -1 it decides, near 0 it "
        "hardly matters, or its best value lies inside. In the best tenth: the middle half of its values there."
    )
    few = front if len(front) <= _MOST else front[np.unique(np.round(np.linspace(0, len(front) - 1, _MOST)).astype(int))]
    designs: list[list[Cell]] = [
        [fixed(float(s.reach[k]), 3), number(float(s.guaranteed[k])), percent(float(s.reached[k]))]
        + [f"{x:.5g}" for x in shown[k].tolist()]
        for k in few.tolist()
    ]
    top: list[Cell] = ["reach, m", "guaranteed", "poses reached", *names]
    told = f"Designs of the front ({len(few)} of {len(front)}): none of the sweep has more of both."
    flattered = (
        "The best of many looks better than it is on the poses on which it was chosen: 'holdfast design' searches further "
        "and checks "
        "what it finds on fresh poses."
    )
    numbers = frozenset(range(2, 5))
    return [
        Picture(figures.svg(figure, f"front{place}", "Guaranteed index against reach of all designs"), text),
        Table(designs, top, frozenset(range(len(top))), caption=told, wide=True),
        Picture(
            figures.svg(by_parameter, f"parameters{place}", "Guaranteed index against each parameter"),
            "Each design by one parameter at a time; the others differ too.",
        ),
        Table(rows, head, numbers, caption=caption, wide=True),
        Text(flattered, quiet=True),
    ]


def _index(s: Swept) -> str:
    return str(s.labels["index"]).replace("-", " ")


def _share(s: Swept) -> str:
    return f"{100 * s.plan['level']:.4g} %"


def _told(values: Array, s: Swept, factor: float) -> tuple[str, str]:
    """How a parameter goes with the guaranteed value, and where it lies in the best tenth."""
    from scipy import stats

    flat = len(values) < 3 or np.ptp(values) == 0 or np.ptp(s.guaranteed) == 0
    rank = np.nan if flat else float(stats.spearmanr(values, s.guaranteed).statistic)
    top = np.argsort(-s.guaranteed, kind="stable")[: max(1, len(values) // 10)]
    low, high = np.quantile(values[top], [0.25, 0.75]) * factor
    return ("–" if np.isnan(rank) else fixed(rank, 2)), f"{low:.4g} to {high:.4g}"


def _bound(s: Swept) -> float | None:
    task = Task.from_dict(s.plan["task"])
    index = by_name(s.plan["index"], from_dict(s.plan["arm"]), task, failures=[list(f) for f in s.plan["failures"]])
    check_digest(index, s.plan)
    return index.bound
