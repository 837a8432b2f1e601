"""``holdfast design ARM --maximise convergence``."""

from __future__ import annotations

from pathlib import Path

from holdfast.arm.task import Task
from holdfast.cli.progress import progress_bar
from holdfast.control.law import Law
from holdfast.designs.convergence import design_for_convergence
from holdfast.designs.space import DesignSpace
from holdfast.present.printing import console, print_json, print_written
from holdfast.registry import LAWS


def converging(
    space: DesignSpace,
    task: str | Task,
    law: str | None,
    designs: int,
    climbs: int,
    keep_reach: bool,
    seed: int,
    out: Path | None,
    json_: bool,
) -> None:
    """Search, print, and write the report, ``designs.csv`` and ``best-arm.yaml``; a sampled search that was stopped goes on."""
    from rich.markup import escape
    from rich.table import Table

    chosen: Law = LAWS.make(law or "pseudoinverse", space.arm, option="--law", task=task)
    with progress_bar(json_, "designs") as progress:
        found = design_for_convergence(
            chosen, space, designs=designs, climbs=climbs, keep_reach=keep_reach, seed=seed, progress=progress, store=out
        )
    files = [] if out is None else found.save(out)
    if json_:
        print_json({**found.to_dict(), "files": [str(f) for f in files]})
        return
    told = console()
    for line in found.describe():
        told.print(escape(line), soft_wrap=True)
    table = Table("parameter", "given arm", "best design", "bounds", box=None, pad_edge=False)
    for p, before, after in zip(space.parameters, space.start.tolist(), found.values[found.best].tolist(), strict=True):
        table.add_row(p.name, p.text(before), p.text(after), f"{p.text(p.lower)} to {p.text(p.upper)}")
    told.print(table)
    print_written(told, files)
