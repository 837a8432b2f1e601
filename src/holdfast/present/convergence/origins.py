"""A workspace analysis: numbers, tables, figures and files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from holdfast.convergence.analysis import ENDS
from holdfast.convergence.origins import Workspace
from holdfast.convergence.table import save_places
from holdfast.notice import says
from holdfast.present import results
from holdfast.present.convergence.places import MEASURES, answer, figure_words, mean_rows, measure_maps, with_interval
from holdfast.present.printing import Rows
from holdfast.present.story import Story
from holdfast.words import capitalised, counted

if TYPE_CHECKING:
    from holdfast.present.results import Drawings

Array = NDArray[np.float64]


def to_dict(w: Workspace) -> dict[str, Any]:
    """Facts of the analysis as JSON types; NaN is None."""
    columns = w.columns
    reached = w.configurations > 0
    return {
        **w.law.arm.entry(),
        "law": w.law.describe(),
        "task": w.law.task.name,
        "target": w.target.tolist(),
        "starts": len(w.places),
        "starts_in_reach": int(reached.sum()),
        "configurations": int(w.configurations.sum()),
        "lost_at_singular_configurations": int(w.lost.sum()),
        "method": w.method,
        "relative_to": w.relative_to,
        "bounds_rad": {name: [list(arc) for arc in arcs] for name, arcs in zip(columns[:-1], w.bounds, strict=True)},
        "ends": dict(zip(ENDS, w.ends.sum(axis=0).tolist(), strict=True)),
        "undecided_fraction": w.undecided,
        "not_simulated_fraction": w.saved,
        "mean_percent": {name: dict(zip(columns, v, strict=True)) for name, v in w.means().items()},
        "mean_percent_95": {name: dict(zip(columns, v, strict=True)) for name, v in w.intervals().items()},
        "starts_with_R100_full": _counts(w, w.reach.full >= 100 - 1e-9),
        "starts_with_R100_none": _counts(w, w.reach.full == 0),
    }


def tables(w: Workspace) -> list[Rows]:
    """Where each joint may lock, the means of the measures, and of samples what holds throughout."""
    values = []
    for joint, arcs in zip(w.law.arm.joints, w.bounds, strict=True):
        factor, unit = joint.shown
        told = ", ".join(f"{factor * a:.2f} to {factor * b:.2f} {unit}" for a, b in arcs)
        values.append([joint.name, told or "no value"])
    sampled = w.method == "sampled"
    found = [Rows(["joint", "target in reach with it at"], values), mean_rows(w, "the starts", sampled)]
    if sampled:
        names = ["R100", "F100"] if w.ends.sum() else ["R100"]
        rows = [
            [column, *(with_interval(100 * i.value, 100 * i.low, 100 * i.high) for i in shares)]
            for column, shares in zip(w.columns, zip(*map(w.throughout, names), strict=True), strict=True)
        ]
        title = "where all configurations that were drawn do, an upper bound for all that there are"
        found.append(Rows(["joint", *(f"starts with {name} 100, percent" for name in names)], rows, title))
    return found


def story(w: Workspace) -> Story:
    """On how much of the way the target stays within reach, and how often the failed arm gets there."""
    nothing = (
        f"None of the {counted(len(w.places), 'start')} has a configuration from which the "
        f"target is reached; choose starts within reach."
    )
    text, facts = answer(w, nothing)
    how = {
        "brute": "all failures simulated, from configurations equally far apart along the self-motion",
        "procedure": "simulated only where a sink exists; elsewhere the arm is taken to reach the target",
        "sampled": "random configurations, all failures simulated",
    }
    return Story(
        f"Starts from which {w.law.arm.name} still reaches a target when a joint locks on the way",
        text,
        about=f"{w.law.arm.name}, {w.law.describe()}",
        facts=facts,
        lines=[f"{capitalised(line)}." for line in w.describe()[1:]],
        figures=figure_words("starts"),
        method=[
            ("Law", w.law.describe()),
            ("Target", ", ".join(f"{x:.4g}" for x in w.target[:3, 3]) + " m"),
            (
                "Starts",
                (
                    f"{int((w.configurations > 0).sum()):,} of {len(w.places):,} within reach, "
                    f"{int(w.configurations.sum()):,} configurations"
                ),
            ),
            ("Failures", f"{how[w.method]}; {w.simulated:,} simulated"),
            ("Measures", MEASURES),
            ("Source", "Goel, Maciejewski, Balakrishnan 2005"),
        ],
        arm=w.law.arm,
    )


def key_table(w: Workspace) -> Rows:
    """The means of the measures."""
    return mean_rows(w, "the starts", w.method == "sampled")


def next_steps(w: Workspace, name: str) -> list[str]:
    """The values of each place, and the whole report."""
    del w
    return [f"{name}.to_xarray()  # place by place", f'{name}.report("workspace.html")']


@says("writing the results")
def save(w: Workspace, folder: Path, command: str = "") -> list[Path]:
    """``workspace.csv``, ``workspace.json``, the figures and the page."""
    columns = ["configurations", "lost", *ENDS, *(f"{name}_{column}_percent" for name in w.measures for column in w.columns)]
    values = [w.configurations, w.lost, w.ends, *w.measures.values()]
    files = save_places(folder, "workspace", w.places, columns, values, w.to_dict())
    return files + results.save(w, folder, command, dpi=130)


def drawings(w: Workspace) -> Drawings:
    """The maps of Fig. 10 by file name: ``reach``, and ``finish`` if failures were looked at.

    For tasks that are not in a plane ``reach-top`` and ``reach-side``, seen along z and along y, and ``finish`` likewise.
    """
    about = (
        f"{w.law.arm.name}, {w.law.name}: {len(w.places)} starts, {int(w.configurations.sum())} configurations; grey: no value"
    )
    failures = ""
    if w.ends.sum():
        failures = f"{w.simulated} failures simulated, {100 * w.undecided:.2f} % undecided at the time limit"
        if w.method == "procedure":
            failures += f", {int(w.ends[:, -1].sum())} locked where no sink is"
    return measure_maps(w.law, w.places, w.measures, about, failures, w.target[:3, 3])


def _counts(w: Workspace, flags: NDArray[np.bool_]) -> dict[str, int]:
    return dict(zip(w.columns, flags.sum(axis=0).tolist(), strict=True))
