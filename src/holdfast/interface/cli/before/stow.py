"""``holdfast stow``."""

from __future__ import annotations

from typing import Annotated

import typer

import holdfast as hf
from holdfast.interface.cli.groups import ArmSourceOptions, ClearanceOptions, FrictionOptions, MountingOptions, OutputOptions
from holdfast.interface.cli.options import NOT_MET_EXIT_CODE, ArmArgument, SeedOption, StartDegreesOption
from holdfast.interface.cli.values import read_configuration, read_numbers


def command(
    arm: ArmArgument,
    start: Annotated[str | None, "Present configuration in rad and m. Default: none."] = None,
    path: Annotated[bool, "Plan the path with the smallest drops from --start."] = False,
    monotone: Annotated[bool, "Plan a path on which the drop exceeds no earlier drop by more than --tolerance."] = False,
    tolerance: Annotated[float, "Tolerance of the drop along the path in m."] = 0.01,
    nodes: Annotated[int, "Number of nodes of the roadmap of the path."] = 3000,
    factor: Annotated[float, "Required ratio of the friction of each joint to the torque that it must hold."] = 1.5,
    speeds: Annotated[
        str | None, "Speed limits in rad/s (m/s): one number or one per joint. Default: those of the arm."
    ] = None,
    samples: Annotated[int, "Number of sampled configurations."] = 200_000,
    friction: FrictionOptions = FrictionOptions(),
    placement: MountingOptions = MountingOptions(),
    apart: ClearanceOptions = ClearanceOptions(),
    degrees: StartDegreesOption = False,
    seed: SeedOption = 1,
    chain: ArmSourceOptions = ArmSourceOptions(),
    output: OutputOptions = OutputOptions(),
) -> None:
    """Find a configuration in which the arm stays without power, and a safe path to it.

    Friction and stops hold the arm there. Along the path, a power loss at any instant drops the tool by no more than from the
    start. Exit code: 0 if the arm holds and the requested path was found, else 3.

    Example: holdfast stow panda --start "0 -45 0 -135 0 90 45" --degrees --coulomb 2,8,2,4,0.5,0.5,0.2
    """
    apart.check_consistency()
    model = placement.mount_arm(chain.resolve_arm(arm))
    limits = None if speeds is None else read_numbers("--speeds", speeds, f"one number or {model.n} numbers")
    stow = hf.stow(
        model,
        None if start is None else read_configuration(model, start, degrees, "--start"),
        friction=friction.read_friction(model),
        factor=factor,
        clearance=apart.build_clearance(model) or False,
        margin=apart.margin or 0.0,
        speeds=None if limits is None else limits[0] if limits.size == 1 else limits,
        samples=samples,
        seed=seed,
    )
    planned = hf.plan_stow_path(stow, monotone=monotone, tolerance=tolerance, nodes=nodes) if path or monotone else None
    output.print_result(stow if planned is None else planned)
    if not stow.holds or (planned is not None and not planned.is_found):
        raise typer.Exit(NOT_MET_EXIT_CODE)
