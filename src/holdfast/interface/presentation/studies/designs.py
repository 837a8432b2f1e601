"""Design sweep in the report of a study: the effect of each parameter of the arm, and the Pareto front."""

from __future__ import annotations

import numpy as np

from holdfast.core.typing import FloatArray
from holdfast.interface import report
from holdfast.interface.presentation.designs.figures import draw_parameters, draw_pareto_front
from holdfast.interface.presentation.presentation import Column, Header, TableSpec
from holdfast.interface.presentation.renderers import build_table_block
from holdfast.interface.presentation.studies.answer import format_index_name, format_level
from holdfast.interface.report.page import Block, Picture, Text
from holdfast.kinematics.indices.index import by_name
from holdfast.kinematics.indices.own_file import check_function_digest
from holdfast.model.arm.task import Task
from holdfast.model.arms.serial import from_dict
from holdfast.studies.designs.designs import choose_best_design
from holdfast.studies.designs.search import find_pareto_front
from holdfast.studies.study_files.jobs.designs import read_design_space
from holdfast.studies.study_files.results import DesignSweep

_MAX_FRONT_DESIGNS = 8  # designs of the Pareto front in the table


def build_sweep_blocks(swept: DesignSweep, place: int) -> list[Block]:
    """Build the figures and tables of a sweep; ``place``, its number from 0, makes the names of figures unique in the page."""
    space = read_design_space(dict(swept.plan))
    factors = np.array([parameter.display_unit[0] for parameter in space.parameters])
    shown_values = swept.values * factors
    parameter_labels = [f"{parameter.name}, {parameter.display_unit[1]}" for parameter in space.parameters]
    label = report.format_label(f"{format_index_name(swept)} of {format_level(swept)} of the poses, at least")
    best, front = choose_best_design(swept.guaranteed, swept.reach), find_pareto_front(swept.reach, swept.guaranteed)
    baseline = None if swept.start is None else (float(swept.reach[swept.start]), float(swept.guaranteed[swept.start]))
    figure = draw_pareto_front(swept.reach, swept.guaranteed, front.tolist(), best, baseline, label, _find_index_bound(swept))
    explanation = (
        f"Index quantile: worst-case {format_index_name(swept)} that {format_level(swept)} of {swept.plan['poses']:,} poses of "
        f"the region ({swept.labels['region']}) have at least, each at its best configuration; a pose that is not reached "
        "counts as 0. Reach: largest distance of the tool point from the base within the joint limits."
    )
    by_parameter = draw_parameters(
        parameter_labels,
        shown_values,
        swept.guaranteed,
        None if baseline is None else (shown_values[swept.start], baseline[1]),
        label,
    )
    parameters = TableSpec(
        "Spearman rank correlation of each parameter with the index quantile. Near 1 or -1 the parameter dominates; near 0 it "
        "has little effect, or its best value lies between the bounds. Best tenth: middle half of its values in the best 10 % "
        "of the designs",
        ["parameter", "unit", "bounds", "rank correlation", "best tenth"],
        [
            [
                *(parameter.name, parameter.display_unit[1], (parameter.lower * factor, parameter.upper * factor)),
                *_compute_parameter_effect(swept.values[:, index], swept, factor),
            ]
            for index, (parameter, factor) in enumerate(zip(space.parameters, factors.tolist(), strict=True))
        ],
    )
    selected = (
        front
        if len(front) <= _MAX_FRONT_DESIGNS
        else front[np.unique(np.round(np.linspace(0, len(front) - 1, _MAX_FRONT_DESIGNS)).astype(int))]
    )
    columns: list[Column] = ["reach, m", "index quantile", Header("poses reached", style="percent")]
    designs = TableSpec(
        f"Designs of the Pareto front ({len(selected)} of {len(front)})",
        [*columns, *(label for label in parameter_labels)],
        [
            [
                *(float(column[index]) for column in (swept.reach, swept.guaranteed, swept.reached)),
                *shown_values[index].tolist(),
            ]
            for index in selected.tolist()
        ],
    )
    optimism_text = (
        "The best design is overestimated on the poses on which it was selected. 'holdfast design' searches further and "
        "evaluates its result on held-out poses."
    )
    return [
        Picture(report.svg(figure, f"front{place}", "Index quantile against reach of all designs"), explanation),
        build_table_block(designs.texts()),
        Picture(
            report.svg(by_parameter, f"parameters{place}", "Index quantile against each parameter"),
            "Each panel shows all designs against one parameter; the other parameters also vary.",
        ),
        build_table_block(parameters.texts()),
        Text(optimism_text, quiet=True),
    ]


def _compute_parameter_effect(values: FloatArray, swept: DesignSweep, factor: float) -> tuple[float, tuple[float, float]]:
    """Compute the rank correlation of a parameter with the index quantile, and its quartiles in the best tenth."""
    from scipy import stats

    is_constant = len(values) < 3 or np.ptp(values) == 0 or np.ptp(swept.guaranteed) == 0
    correlation = np.nan if is_constant else float(stats.spearmanr(values, swept.guaranteed).statistic)
    best_rows = np.argsort(-swept.guaranteed, kind="stable")[: max(1, len(values) // 10)]
    lower, upper = np.quantile(values[best_rows], [0.25, 0.75]) * factor
    return correlation, (lower, upper)


def _find_index_bound(swept: DesignSweep) -> float | None:
    task = Task.from_dict(swept.plan["task"])
    index = by_name(
        swept.plan["index"], from_dict(swept.plan["arm"]), task, failures=[list(failure) for failure in swept.plan["failures"]]
    )
    check_function_digest(index, swept.plan)
    return index.bound
