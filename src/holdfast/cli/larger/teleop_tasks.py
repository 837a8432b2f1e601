"""``holdfast teleop tasks``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from holdfast.cli.larger.stages import working
from holdfast.cli.options import JsonOption, read_arm, read_task
from holdfast.files.output import made, replaced
from holdfast.present.printing import console, number, print_json

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from holdfast.arm.model import Arm
    from holdfast.arm.task import Task
    from holdfast.teleop.bank.selection import Binning
    from holdfast.teleop.bank.tasks import TaskBank
    from holdfast.teleop.protocol.protocol import Protocol

    Indices = NDArray[np.int64]


def tasks(
    arm: Annotated[str, typer.Argument(metavar="[ARM]", help="Built-in name, URDF or MJCF file, or DH table.")] = "planar-3r",
    per_joint: Annotated[
        int, typer.Option("--per-joint", min=1, help="Tasks in which this joint fails, for each joint.")
    ] = 400,
    distance: Annotated[float, typer.Option("--distance", help="From start to target, m.")] = 2.0,
    seed: Annotated[int, typer.Option("--seed", min=0, help="The same seed gives the same tasks.")] = 0,
    select: Annotated[
        int, typer.Option("--select", min=1, help="Tasks to choose, one from each cell as far as there are.")
    ] = 22,
    special: Annotated[
        bool,
        typer.Option(
            "--special/--no-special",
            help="Also the most disorienting task, and one in which the failed arm is drawn to where it stands still.",
        ),
    ] = True,
    task: Annotated[
        str | None, typer.Option("--task", help="What the stick moves: planar or position.", show_default="by the arm")
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", help="Folder for bank.csv, protocol.yaml and bank.png.", show_default=False),
    ] = None,
    json_: JsonOption = False,
) -> None:
    """Random tasks, each run by the computer in four scenarios, and the choice of those for an experiment.

    Example: holdfast teleop tasks --seed 1 --out bank
    """
    from holdfast.teleop.bank.selection import binning, most_disorienting, trapped
    from holdfast.teleop.bank.selection import select as chosen_of
    from holdfast.teleop.bank.tasks import task_bank

    model = read_arm(arm, None, None)
    rows = read_task(task, arm, model) if task is not None else _rows(model)
    with working("running the tasks") as say:
        bank = task_bank(model, per_joint, None, distance, rows, seed)
        say("choosing")
        cells = binning(bank)
        chosen = chosen_of(bank, cells, select)
        apart: list[int] = []
        stuck: int | None = None
        if special:
            apart.append(most_disorienting(bank, chosen))
            stuck = trapped(bank, model, rows, seed)
            apart += [] if stuck is None else [stuck]
        files = [] if out is None else _folder(out, arm, model, rows, bank, cells, chosen, apart, seed)
    if json_:
        data = {
            **model.entry(),
            "tasks": len(bank),
            "cells_occupied": len(cells.occupied),
            "chosen": chosen + 1,
            "most_disorienting": apart[0] + 1 if special else None,
            "trapped": None if stuck is None else stuck + 1,
            "scenarios": _summary(bank),
        }
        print_json(data)
        return
    _print(model, bank, cells, chosen, special, apart, stuck)
    for file in files:
        typer.echo(f"written: {file}")


def _rows(arm: Arm) -> str:
    """What a stick moves if nothing is said: the plane of an arm that moves in one, else the position."""
    from holdfast.arm.task import plane_normal

    return "planar" if plane_normal(arm) is not None else "position"


def _folder(
    out: Path,
    spec: str,
    arm: Arm,
    rows: str | Task,
    bank: TaskBank,
    cells: Binning,
    chosen: Indices,
    apart: list[int],
    seed: int,
) -> list[Path]:
    from holdfast.files.spreadsheet import csv_text
    from holdfast.present.teleop.bank import bank_figure
    from holdfast.report.figures import save_png
    from holdfast.teleop.records.tables import bank_table

    every = np.append(chosen, np.array(apart, dtype=np.int64)).astype(np.int64)
    file = made(out) / "bank.csv"
    replaced(file, csv_text(bank_table(bank, arm, cells)))
    protocol = _protocol(spec, arm, rows, bank, every, seed)
    figure = bank_figure(bank, cells, chosen, np.array(apart, dtype=np.int64))
    return [file, protocol.write(out / "protocol.yaml"), save_png(figure, out / "bank.png", 150)]


def _protocol(spec: str, arm: Arm, rows: str | Task, bank: TaskBank, every: Indices, seed: int) -> Protocol:
    """The paper's protocol with this arm and these tasks."""
    from holdfast import arms
    from holdfast.arm.task import as_task
    from holdfast.teleop.protocol.protocol import read_protocol

    file = None if spec in arms.names() else Path(spec)
    base = replace(
        read_protocol(),
        name=f"{arm.name}, {len(every)} tasks of a bank of {len(bank)}, seed {seed}",
        arm=arm,
        arm_spec=spec if file is None else file.name,
        arm_file=file,
        rows=as_task(arm, rows),
    )
    with np.errstate(invalid="ignore"):
        notes = [
            f"bank task {k + 1}, CPM3 {bank.difficulty[k]:.3f}, CPM4/CPM3 {bank.ratio[k]:.3f}"
            if np.isfinite(bank.ratio[k])
            else f"bank task {k + 1}, not completed by the computer in every scenario"
            for k in every
        ]
    return base.with_tasks(bank.tasks.take(every), notes)


def _summary(bank: TaskBank) -> list[dict[str, float | int | str]]:
    lines: list[dict[str, float | int | str]] = []
    for k, s in enumerate(bank.scenarios):
        arrived = ~np.isnan(bank.cpm[k])
        middle = np.nanmedian(bank.measures[k], axis=0) if arrived.any() else np.full(bank.measures.shape[2], np.nan)
        lines.append(
            {
                "scenario": s.number,
                "label": s.label,
                "not_arrived": int((~arrived).sum()),
                "time_cycles": float(middle[0]),
                "path_m": float(middle[1]),
                "velocity_error": float(middle[6]),
                "peak_direction_error_rad": float(middle[9]),
                "cpm": float(np.median(bank.cpm[k][arrived])) if arrived.any() else float("nan"),
            }
        )
    return lines


def _print(
    arm: Arm, bank: TaskBank, cells: Binning, chosen: Indices, special: bool, apart: list[int], stuck: int | None
) -> None:
    from rich.markup import escape
    from rich.table import Table

    out = console()
    count = (len(cells.difficulty) - 1) * (len(cells.ratio) - 1)
    out.print(
        f"Arm {escape(arm.title)}: {len(bank)} tasks in {len(bank.scenarios)} scenarios, the computer steers", soft_wrap=True
    )
    table = Table(
        "scenario",
        "",
        "not arrived",
        "time, cycles",
        "path, m",
        "velocity error",
        "peak direction error, deg",
        "CPM",
        box=None,
        pad_edge=False,
    )
    for r in _summary(bank):
        turn = np.degrees(float(r["peak_direction_error_rad"]))
        cells_of_row = [number(float(r[k]), 3) for k in ("time_cycles", "path_m", "velocity_error")]
        table.add_row(
            str(r["scenario"]), str(r["label"]), str(r["not_arrived"]), *cells_of_row, f"{turn:.1f}", number(float(r["cpm"]), 3)
        )
    out.print(table)
    good = bank.completed()
    better = float((bank.ratio[good] < 1).mean())
    for line in (
        "medians over the tasks that arrive; the level of CPM is set by the most extreme trial, compare ratios",
        f"failure-tolerant inverse better with the failed arm (CPM4/CPM3 below 1): {100 * better:.0f} % of the tasks",
        f"{len(cells.occupied)} of {count} cells of CPM3 and CPM4/CPM3 hold a task; chosen, by CPM3: "
        f"{' '.join(str(k + 1) for k in chosen)}",
    ):
        out.print(line, soft_wrap=True)
    if special:
        out.print(f"most disorienting of the others: {apart[0] + 1}", soft_wrap=True)
        found = (
            "no task of the bank draws the failed arm under the pseudoinverse to where it stands still and can yet be steered; "
            "another seed may have one, and the protocol goel2003 has one by construction"
            if stuck is None
            else f"drawn to where it stands still, and yet can be steered: {stuck + 1}"
        )
        out.print(found, soft_wrap=True)
