"""What an evolution strategy found, in numbers and words, and its folder."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from holdfast.designs.evolution.found import EvolvedDesign
from holdfast.files.output import put
from holdfast.present import results
from holdfast.present.printing import Rows, number
from holdfast.present.story import Story
from holdfast.words import capitalised

ARM_FILE = "best-arm.yaml"


def to_dict(d: EvolvedDesign) -> dict[str, Any]:
    """The arm's numbers and what it is worth, rad, m, m^2 and whole turns."""
    return {
        **d.space.arm.entry(),
        "objective": d.objective,
        "values": dict(zip(d.space.names, d.values.tolist(), strict=True)),
        "value": d.value,
        "given": d.given,
        "unit": d.unit,
        "bound": d.bound,
        "q": None if d.q is None else d.q.tolist(),
        "winding": None if d.winding is None else d.winding.tolist(),
        "limits": None if d.limits is None else d.limits.tolist(),
        "generations": len(d.history),
        "seed": d.seed,
        "seconds": d.seconds,
    }


def tables(d: EvolvedDesign) -> list[Rows]:
    """The given arm and the one found, number by number."""
    return [key_table(d)]


def key_table(d: EvolvedDesign) -> Rows:
    """The same for notebooks."""
    pairs = zip(d.space.parameters, d.space.start.tolist(), d.values.tolist(), strict=True)
    rows = [[p.name, p.text(before), p.text(after)] for p, before, after in pairs]
    return Rows(["", "given arm", "best design"], [*rows, [f"{d.objective}, {d.unit}", f"{d.given:.5g}", f"{d.value:.5g}"]])


def figures(d: EvolvedDesign) -> dict[str, Figure]:
    """The best value after each generation, beside what no arm can beat."""
    from holdfast.report.motions import Panel, motion_figure

    level = d.bound, "no arm of these bounds has more"
    panel = Panel(np.arange(1.0, len(d.history) + 1), d.history, f"{d.objective}, {d.unit}", "Best so far", level=level)
    return {"search": motion_figure([panel], _searched(d), "generation")}


def story(d: EvolvedDesign) -> Story:
    """What the arm is worth, beside the given one and what none can beat."""
    first, *others = (f"{capitalised(line)}." for line in d.describe())
    return Story(
        f"Design of {d.space.arm.name} for {d.objective.replace('-', ' ')}",
        first,
        about=", ".join(d.space.names),
        facts=[(f"{number(d.value)} {d.unit}", "the best design"), (f"{number(d.given)} {d.unit}", "the given arm")],
        lines=others,
        figures={
            "search": ("How it was found", "The best value after each generation of the search; dashed what none can beat.")
        },
        method=[("Search", _searched(d))],
        arm=d.space.arm,
    )


def _searched(d: EvolvedDesign) -> str:
    return f"an evolution strategy, {len(d.history):,} generations in {number(d.seconds)} s, seed {d.seed}"


def next_steps(d: EvolvedDesign, name: str) -> list[str]:
    """The same measured by what shares nothing with the search."""
    if d.q is not None:
        return [f"hf.self_motion({name}.arm(), {name}.arm().forward_kinematics({name}.q), spacing=0.02).size"]
    return [f'hf.tolerant_workspace({name}.arm(), "planar", {name}.limits).size']


def save(d: EvolvedDesign, folder: Path, command: str = "") -> list[Path]:
    """best-arm.yaml and report.html."""
    return [*put(folder, {ARM_FILE: d.arm_file()}), *results.save(d, folder, command)]
