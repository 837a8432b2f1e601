"""Presentation of a search for arm designs that still reach their targets after an undetected lock."""

from __future__ import annotations

import shlex
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from holdfast.core.files.output import replace_file
from holdfast.core.formatting import format_percent
from holdfast.core.probability.intervals import Difference, Interval
from holdfast.interface import report
from holdfast.interface.presentation.commands import build_command_block
from holdfast.interface.presentation.convergence.shares import format_points
from holdfast.interface.presentation.designs.figures import draw_parameters
from holdfast.interface.presentation.designs.parameters import (
    ARM_FILE,
    build_arm_section,
    list_bound_notices,
    tabulate_parameters,
)
from holdfast.interface.presentation.presentation import (
    Column,
    Fact,
    FigureSpec,
    Presentation,
    TableSpec,
    format_value,
    make_headers,
)
from holdfast.interface.report.page import Section
from holdfast.model import arms
from holdfast.studies.designs.convergence import DEFAULT_TARGETS, FAILURES_PER_JOINT, ConvergenceDesigns

_MEASURE_MEANINGS = {
    "guaranteed": "fraction of the targets, by area, that the arm reaches after every lock that leaves them within reach",
    "free": "fraction of the locks with the target within reach after which no sink or trap stops the arm elsewhere",
    "converged": "fraction of all locks after which the arm reaches its target; a target out of reach counts as 0",
    "reached": "fraction of the targets within reach of the healthy arm",
}


def to_dict(designs: ConvergenceDesigns) -> dict[str, Any]:
    """Return the baseline arm and the best design as JSON data, in rad, m, and fractions."""

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


def present(designs: ConvergenceDesigns) -> Presentation:
    """Present the best design, its gain over the baseline arm, and the search."""
    law, best, is_given = designs.law, designs.best, designs.best == 0
    measures = [
        (name, float(measure[0]), float(measure[best]), _MEASURE_MEANINGS[name]) for name, measure in designs.measures.items()
    ]
    if designs.checked is not None:
        given_value, best_value = designs.checked[0].value, designs.checked[1].value
        label = "of the held-out failures after which the arm reaches its target:"
        phrases = (f"{label} baseline arm", f"{label} best design")
    else:
        measure = _objective_values(designs)
        given_value, best_value = float(measure[0]), float(measure[best])
        phrases = (f"{designs.objective}, baseline arm", f"{designs.objective}, best design")
    facts = [] if is_given else [Fact("", best_value, phrase=phrases[1], style="percent")]
    facts.append(Fact("", given_value, phrase=phrases[0], style="percent"))
    facts.append(Fact("designs", len(designs.values), phrase="designs were evaluated"))
    columns: list[Column] = ["measure", *make_headers("baseline arm", "best design", style="percent"), "meaning"]
    tables = [tabulate_parameters(designs.space, designs.values[best]), TableSpec("Measured in the search", columns, measures)]
    settings = designs.searched
    measured = (
        "from the stationary points of the planar arm, for all targets"
        if designs.exact
        else f"simulation of {settings['targets']} targets with {settings['failures']} failures of each joint, the same for "
        "all designs; a joint locks at its position in a random configuration of the target, and the arm starts at random"
    )
    caption = (
        "Each panel shows all designs against one parameter; the others vary too. Local searches end near the best design."
    )
    can_rerun = designs.exact or (settings["targets"], settings["failures"]) == (DEFAULT_TARGETS, FAILURES_PER_JOINT)
    return Presentation(
        f"Designs of {law.arm.name} that reach their targets after an undetected lock",
        _compose_answer(designs),
        about=f"{law.arm.title} under {law.describe()}; {', '.join(designs.space.names)}",
        lines=(
            ["The absence of sinks and singular traps does not prove convergence, because limit cycles exist."]
            if designs.checked is None
            else []
        ),
        notices=[] if is_given else list_bound_notices(designs.space, designs.values[best]),
        facts=facts,
        tables=tables,
        figures={"parameters": FigureSpec(partial(_draw_parameters, designs), "Effect of parameters", caption, saved=False)},
        sections=partial(_build_sections, designs),
        method=[
            ("Law", law.describe()),
            ("Measured", measured),
            (
                "Search",
                f"{settings['designs']:,} Sobol designs, those with equal lengths, and pattern searches from "
                f"{settings['climbs']} of them",
            ),
            *([] if designs.checked is None else [("Held-out failures", "targets and failures that the search did not use")]),
            ("Seed", str(settings["seed"])),
        ],
        arm=law.arm,
        again=(lambda: [build_command_block(*format_command(designs))]) if can_rerun else tuple,
        exports={"designs.csv": partial(_write_designs, designs), ARM_FILE: partial(_write_arm, designs)},
    )


def _objective_values(designs: ConvergenceDesigns) -> Any:
    return designs.measures[designs.objective if designs.exact else "converged"]


def _compose_answer(designs: ConvergenceDesigns) -> str:
    """Compose the answer in one or two sentences."""
    if designs.checked is not None:
        baseline, best, difference = designs.checked
        if designs.best == 0:
            return (
                "No design better than the baseline arm was found: after an undetected lock it reaches its target in "
                f"{format_value(baseline, 'percent')} of the held-out failures."
            )
        text = (
            "After an undetected lock, the best design reaches its target in "
            f"{format_value(best, 'percent')} of the held-out failures, and the baseline arm in "
            f"{format_value(baseline, 'percent')}. The difference is {format_points(difference)} percentage points."
        )
        return text if difference.low > 0 else f"No gain was found on held-out failures. {text} Search with more targets."
    name = designs.objective if designs.exact else "converged"
    baseline_text, best_text = (format_percent(float(designs.measures[name][design])) for design in (0, designs.best))
    if designs.best == 0:
        text = f"No design better than the baseline arm was found. Its measure '{name}' is {baseline_text}."
    else:
        text = f"The measure '{name}' is {best_text} for the best design and {baseline_text} for the baseline arm."
    return f"{text} It is the {_MEASURE_MEANINGS[name]}."


def _draw_parameters(designs: ConvergenceDesigns) -> report.Figure:
    """Draw the value of each design against each parameter."""
    factors = np.array([parameter.display_unit[0] for parameter in designs.space.parameters])
    names = [f"{parameter.name}, {parameter.display_unit[1]}" for parameter in designs.space.parameters]
    values = _objective_values(designs)
    baseline = designs.values[0] * factors, float(values[0])
    return draw_parameters(names, designs.values * factors, values, baseline, f"fraction, {designs.objective}")


def _build_sections(designs: ConvergenceDesigns) -> list[Section]:
    remark = "The file has no link masses, because a Denavit-Hartenberg table does not contain them."
    return [build_arm_section(designs.space, designs.values[designs.best], designs.arm_file(), remark)]


def format_command(designs: ConvergenceDesigns) -> tuple[str, str]:
    """Return the command that repeats the search, and a remark."""
    settings = designs.searched
    arm_spec, words, remark = arms.command_words(designs.law.arm)
    words += [f"--maximise convergence --law {shlex.quote(designs.law.label)} --task {shlex.quote(designs.law.task.name)}"]
    words += [f"--vary {shlex.quote(parameter.option_text)}" for parameter in designs.space.parameters] + [
        "--keep-reach"
    ] * bool(settings.get("keep_reach"))
    words.append(f"--designs {settings['designs']} --local-searches {settings['climbs']} --seed {settings['seed']}")
    return " \\\n    ".join([f"holdfast design {shlex.quote(arm_spec)}", *words]), remark


def _write_designs(designs: ConvergenceDesigns, path: Path) -> None:
    """Write a row for each design with its values (m, rad) and measures (fractions)."""
    lines = [",".join((*designs.space.names, *designs.measures))]
    columns = [*designs.values.T.tolist(), *(measure.tolist() for measure in designs.measures.values())]
    lines += [",".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True)]
    replace_file(path, "\n".join(lines) + "\n")


def _write_arm(designs: ConvergenceDesigns, path: Path) -> None:
    replace_file(path, designs.arm_file())
