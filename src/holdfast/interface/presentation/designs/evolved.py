"""Numbers, text and folder of the design that an evolution strategy found."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from holdfast.core.files.output import write_files
from holdfast.core.formatting import capitalise_first
from holdfast.interface.presentation import results
from holdfast.interface.presentation.page_content import PageContent
from holdfast.interface.presentation.printing import TextTable, format_significant
from holdfast.studies.designs.evolution.found import EvolvedDesign

ARM_FILE = "best-arm.yaml"


def to_dict(design: EvolvedDesign) -> dict[str, Any]:
    """Return the parameters of the arm and its value, rad, m, m^2 and full revolutions, as JSON data."""
    return {
        **design.space.arm.entry(),
        "objective": design.objective,
        "values": dict(zip(design.space.names, design.values.tolist(), strict=True)),
        "value": design.value,
        "given": design.given,
        "unit": design.unit,
        "bound": design.bound,
        "q": None if design.q is None else design.q.tolist(),
        "winding": None if design.winding is None else design.winding.tolist(),
        "limits": None if design.limits is None else design.limits.tolist(),
        "generations": len(design.history),
        "seed": design.seed,
        "seconds": design.seconds,
    }


def tables(design: EvolvedDesign) -> list[TextTable]:
    """Return the baseline arm and the best design, number by number."""
    return [key_table(design)]


def key_table(design: EvolvedDesign) -> TextTable:
    """Return the baseline arm and the best design, number by number, for notebooks."""
    parameter_values = zip(design.space.parameters, design.space.start.tolist(), design.values.tolist(), strict=True)
    table_rows = [
        [parameter.name, parameter.text(before), parameter.text(after)] for parameter, before, after in parameter_values
    ]
    return TextTable(
        ["", "given arm", "best design"],
        [*table_rows, [f"{design.objective}, {design.unit}", f"{design.given:.5g}", f"{design.value:.5g}"]],
    )


def figures(design: EvolvedDesign) -> dict[str, Figure]:
    """Draw the best value after each generation, with the upper bound for arms within the same limits."""
    from holdfast.interface.report.motions import TimePanel, motion_figure

    level = design.bound, "no arm of these bounds has more"
    panel = TimePanel(
        np.arange(1.0, len(design.history) + 1),
        design.history,
        f"{design.objective}, {design.unit}",
        "Best so far",
        reference_level=level,
    )
    return {"search": motion_figure([panel], _describe_search(design), "generation")}


def story(design: EvolvedDesign) -> PageContent:
    """Compose the report: the value of the arm, compared with the baseline arm and the upper bound."""
    first_sentence, *others = (f"{capitalise_first(line)}." for line in design.describe())
    return PageContent(
        f"Design of {design.space.arm.name} for {design.objective.replace('-', ' ')}",
        first_sentence,
        about=", ".join(design.space.names),
        facts=[
            (f"{format_significant(design.value)} {design.unit}", "the best design"),
            (f"{format_significant(design.given)} {design.unit}", "the given arm"),
        ],
        lines=others,
        figures={
            "search": ("How it was found", "The best value after each generation of the search; dashed what none can beat.")
        },
        method=[("Search", _describe_search(design))],
        arm=design.space.arm,
    )


def _describe_search(design: EvolvedDesign) -> str:
    return (
        f"an evolution strategy, {len(design.history):,} generations in {format_significant(design.seconds)} s, seed "
        f"{design.seed}"
    )


def next_steps(design: EvolvedDesign, name: str) -> list[str]:
    """Suggest the measurement of the same value by independent code."""
    if design.q is not None:
        return [f"hf.self_motion({name}.arm(), {name}.arm().forward_kinematics({name}.q), spacing=0.02).size"]
    return [f'hf.tolerant_workspace({name}.arm(), "planar", {name}.limits).size']


def save(design: EvolvedDesign, folder: Path, command: str = "") -> list[Path]:
    """Save best-arm.yaml and report.html."""
    return [*write_files(folder, {ARM_FILE: design.arm_file()}), *results.save(design, folder, command)]
