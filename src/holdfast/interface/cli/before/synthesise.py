"""``holdfast synthesise``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.files import output
from holdfast.core.files.matrices import read_matrix
from holdfast.interface.cli.options import JsonOption, SeedOption
from holdfast.interface.presentation.results import print_result, print_results


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
    input_matrix = read_matrix(file)
    synthesis = hf.designs.synthesise(
        jacobian=None if null_space else input_matrix,
        null_space=input_matrix if null_space else None,
        task=task,
        failures=failures,
        starts=starts,
        seed=seed,
    )
    if judge and task != "pose":
        raise InputError("orders are judged for poses; leave --judge out")
    folder = Path() if out is None else output.make_folder(out)
    files = (
        []
        if out is None
        else [hf.designs.write_dh_table(arm, folder / f"arm-{number}.yaml") for number, arm in enumerate(synthesis.arms, 1)]
    )
    evaluated_orders = [hf.designs.compare_joint_orders(synthesis.jacobians[0], failures=failures, seed=seed)] if judge else []
    if json_ and judge:
        print_results([synthesis, *evaluated_orders], json_)
        return
    print_result(synthesis, json_, files)
    for order in evaluated_orders:
        print_result(order, json_)
