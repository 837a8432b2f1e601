"""``holdfast follow``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.groups import ArmSourceOptions, ClearanceOptions, MountingOptions, PathOptions
from holdfast.interface.cli.measure_options import MaximiseOption, MinimiseOption
from holdfast.interface.cli.options import ArmArgument, DegreesOption, JsonOption, MotionCsvOption, RrdOption
from holdfast.interface.cli.values import read_configuration, read_objective
from holdfast.interface.presentation.results import current_command, print_result


def command(
    arm: ArmArgument,
    tracked: PathOptions,
    minimise: MinimiseOption = None,
    maximise: MaximiseOption = None,
    method: Annotated[
        str, "Method: gradient-projection, extended-jacobian, augmented-jacobian or none (least-norm rates, for comparison)."
    ] = "gradient-projection",
    q: Annotated[str | None, "Start configuration in rad and m. Default: the best configuration of the first pose."] = None,
    degrees: DegreesOption = False,
    gain: Annotated[
        float | None,
        "Feedback gain: rad/s per unit of the objective with gradient-projection, else 1/s. Default: keeps the lag negligible.",
    ] = None,
    wanted: Annotated[float | None, "Value of the objective that augmented-jacobian keeps. Default: that of the start."] = None,
    rate_cap: Annotated[
        float | None, "Largest norm of the joint rates in rad/s; slows only the self-motion. Default: 20,000 steps of 0.02 rad."
    ] = None,
    samples: Annotated[int, "Number of samples over the duration."] = 501,
    best: Annotated[bool, "Also find the best configuration of each pose (one or two degrees of redundancy)."] = False,
    torque_bound: Annotated[
        float | None,
        "Allowed difference of torques from gravity torques in N m; the result then states how slow the motion must be.",
    ] = None,
    apart: ClearanceOptions = ClearanceOptions(),
    no_limits: Annotated[bool, "Ignore joint limits during the motion."] = False,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the search for a start configuration.")] = 0,
    placement: MountingOptions = MountingOptions(),
    chain: ArmSourceOptions = ArmSourceOptions(),
    out: Annotated[Path | None, "Folder for trajectory.csv and report.html."] = None,
    csv: MotionCsvOption = None,
    rrd: RrdOption = None,
    parquet: Annotated[Path | None, "Parquet file for the motion (needs holdfast-arms[parquet])."] = None,
    json_: JsonOption = False,
) -> None:
    """Track a tool path while the null-space motion optimises fault tolerance.

    Example: holdfast follow panda path.yaml --minimise torque:effort --out motion
    """
    if (minimise is None) == (maximise is None):
        raise InputError("give one of --minimise and --maximise, for example --minimise torque:effort")
    apart.check_consistency()
    model = placement.mount_arm(chain.resolve_arm(arm))
    timed, path_task = tracked.load_path(arm, model)
    option_and_text = ("--minimise", minimise) if minimise is not None else ("--maximise", maximise or "")
    objective = read_objective(model, *option_and_text, path_task)  # negated already where necessary
    optimisation: dict[str, Any] = {"minimise" if objective.better == "smaller" else "maximise": objective}
    result = hf.follow(
        model,
        timed,
        **optimisation,
        method=method,  # type: ignore[arg-type]
        q=None if q is None else read_configuration(model, q, degrees),
        gain=gain,
        wanted=wanted,
        rate_cap=rate_cap,
        task=path_task,
        samples=samples,
        limits=not no_limits,
        seed=seed,
        best=best,
        torque_bound=torque_bound,
        clearance=apart.build_if_requested(model),
        margin=apart.margin or 0.0,
    )
    files = [] if csv is None else [result.to_csv(csv)]
    if rrd is not None:
        files.append(result.to_rrd(rrd))
    if parquet is not None:
        files.append(result.to_parquet(parquet))
    if out is not None:
        files += result.save(out, command=current_command())
    print_result(result, json_, files)
