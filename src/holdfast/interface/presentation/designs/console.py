"""Numbers and console text of designs of an arm: those for an index, and those for convergence."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from holdfast.core.formatting import format_percent
from holdfast.core.probability.intervals import Difference, Interval
from holdfast.interface.presentation.printing import TextTable
from holdfast.studies.designs.convergence import ConvergenceDesigns
from holdfast.studies.designs.designs import Designs, HeldOutResult, format_level, format_value_interval
from holdfast.studies.designs.space import DesignParameter

if TYPE_CHECKING:
    from rich.console import Console

_BOUND_TOLERANCE = 1e-6  # of the width between the bounds


def name_reached_bound(parameter: DesignParameter, value: float) -> str:
    """Return ``lower`` or ``upper`` if a value is at that bound of the parameter, else an empty string."""
    slack = _BOUND_TOLERANCE * (parameter.upper - parameter.lower)
    return "lower" if value <= parameter.lower + slack else "upper" if value >= parameter.upper - slack else ""


def to_dict(designs: Designs | ConvergenceDesigns) -> dict[str, Any]:
    """Return the baseline arm and the best design, rad, m and fractions, as JSON data."""
    return _collect_index_designs(designs) if isinstance(designs, Designs) else _collect_convergence_designs(designs)


def _collect_index_designs(designs: Designs) -> dict[str, Any]:
    def describe_arm(number: int, checked: HeldOutResult) -> dict[str, Any]:
        guaranteed = checked.guaranteed
        return {
            "values": dict(zip(designs.space.names, designs.values[number].tolist(), strict=True)),
            "guaranteed_in_search": float(designs.guaranteed[number]),
            "guaranteed": {
                "value": guaranteed.value,
                "low": guaranteed.low,
                "high": guaranteed.high,
                "confidence": guaranteed.confidence,
            },
            "median": float(checked.distribution.quantile(0.5, reachable_only=False)),
            "reached": 1 - checked.distribution.unreached_share,
            "reach": float(designs.reach[number]),
        }

    return {
        **designs.space.arm.entry(),
        "index": designs.index.label,
        "task": designs.index.task.name,
        "region": designs.region.name,
        "level": designs.level,
        "bound": designs.index.bound,
        "poses": designs.poses,
        "fresh_poses": designs.checked.best.distribution.samples,
        "designs": len(designs.values),
        "given": describe_arm(0, designs.checked.given),
        "best": describe_arm(designs.best, designs.checked.best),
        "optimism": designs.checked.optimism,
        "front": [
            {
                "reach": float(designs.reach[design]),
                "guaranteed": float(designs.guaranteed[design]),
                "values": dict(zip(designs.space.names, designs.values[design].tolist(), strict=True)),
            }
            for design in designs.front.tolist()
        ],
        "seed": designs.seed,
    }


def _collect_convergence_designs(designs: ConvergenceDesigns) -> dict[str, Any]:
    def describe_design(number: int) -> dict[str, Any]:
        values = dict(zip(designs.space.names, designs.values[number].tolist(), strict=True))
        return {"values": values, **{name: float(measure[number]) for name, measure in designs.measures.items()}}

    data: dict[str, Any] = {
        **designs.law.arm.entry(),
        "law": designs.law.label,
        "task": designs.law.task.name,
        "objective": designs.objective,
        "exact": designs.exact,
        "designs": len(designs.values),
        "given": describe_design(0),
        "best": describe_design(designs.best),
    }
    if designs.checked is not None:
        baseline, best, difference = designs.checked
        estimates: dict[str, Interval | Difference] = {"given": baseline, "best": best, "difference": difference}
        data["fresh"] = {
            n: {"value": estimate.value, "low": estimate.low, "high": estimate.high} for n, estimate in estimates.items()
        }
    return data


def key_table(designs: Designs | ConvergenceDesigns) -> TextTable:
    """Return the baseline arm and the best design, number by number, and their values."""
    parameter_values = zip(
        designs.space.parameters, designs.space.start.tolist(), designs.values[designs.best].tolist(), strict=True
    )
    table_rows = [
        [parameter.name, parameter.text(before), parameter.text(after)] for parameter, before, after in parameter_values
    ]
    if isinstance(designs, Designs):
        baseline, best = (
            format_value_interval(checked.guaranteed) for checked in (designs.checked.given, designs.checked.best)
        )
        table_rows += [
            [f"{designs.index.name}, {format_level(designs.level)} of poses", baseline, best],
            ["reach, m", f"{designs.start_reach:.3f}", f"{designs.reach[designs.best]:.3f}"],
        ]
    else:
        table_rows += [
            [name, format_percent(float(measure[0])), format_percent(float(measure[designs.best]))]
            for name, measure in designs.measures.items()
        ]
    return TextTable(["", "given arm", "best design"], table_rows)


def next_steps(designs: Designs | ConvergenceDesigns, name: str) -> list[str]:
    """Suggest the best arm and the full report."""
    del designs
    return [f"{name}.arm()  # the best one", f'{name}.report("designs.html")']


def show(designs: Designs | ConvergenceDesigns, out: Console) -> None:
    """Print the answer, and the baseline arm and the best design, number by number."""
    from rich.markup import escape

    from holdfast.interface.presentation.terminal import BandedTable

    lines = designs.describe()
    last_line = lines.pop() if isinstance(designs, Designs) else ""
    for line in lines:
        out.print(escape(line), soft_wrap=True)
    table = BandedTable("parameter", "given arm", "best design", "bounds")
    for parameter, before, after in zip(
        designs.space.parameters, designs.space.start.tolist(), designs.values[designs.best].tolist(), strict=True
    ):
        bound_name = name_reached_bound(parameter, after) if isinstance(designs, Designs) else ""
        bound_remark = f" (at the {bound_name} bound)" if bound_name else ""
        table.add_row(
            parameter.name,
            parameter.text(before),
            parameter.text(after) + bound_remark,
            f"{parameter.text(parameter.lower)} to {parameter.text(parameter.upper)}",
        )
    out.print(table)
    if last_line:
        out.print(escape(last_line), soft_wrap=True)
