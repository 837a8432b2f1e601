"""``holdfast synthesise``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.cli.options import JsonOption, SeedOption
from holdfast.errors import InputError
from holdfast.files import output
from holdfast.files.matrices import matrix
from holdfast.present.results import printed, printed_each


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Numbers, a row of the matrix a line (CSV).")],
    task: Annotated[str, "planar, position or pose."] = "pose",
    null_space: Annotated[bool, "The file is a null space, a row for each joint, not a Jacobian."] = False,
    failures: Annotated[int, "Joints that lock at once."] = 1,
    starts: Annotated[int, "Starts of the search for axes."] = 12,
    judge: Annotated[bool, "Judge all orders of the axes of the best arm, too: poses."] = False,
    seed: SeedOption = 0,
    out: Annotated[Path | None, "Folder for the arms, as YAML."] = None,
    json_: JsonOption = False,
) -> None:
    """Construct revolute arms with a given Jacobian or null space at q = 0.

    A Jacobian has 2, 3 or 6 rows, m and rad, linear above angular. Its null space alone says what locks leave.

    Example: holdfast synthesise jacobian.csv --task position --out arms
    """
    given = matrix(file)
    made = hf.designs.synthesise(
        jacobian=None if null_space else given,
        null_space=given if null_space else None,
        task=task,
        failures=failures,
        starts=starts,
        seed=seed,
    )
    if judge and task != "pose":
        raise InputError("orders are judged for poses; leave --judge out")
    folder = Path() if out is None else output.made(out)
    files = [] if out is None else [hf.designs.written(arm, folder / f"arm-{k}.yaml") for k, arm in enumerate(made.arms, 1)]
    judged = [hf.designs.judge_orders(made.jacobians[0], failures=failures, seed=seed)] if judge else []
    if json_ and judge:
        printed_each([made, *judged], json_)
        return
    printed(made, json_, files)
    for found in judged:
        printed(found, json_)
