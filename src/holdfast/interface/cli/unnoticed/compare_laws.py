"""``holdfast compare-laws``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.formatting import format_count
from holdfast.interface.cli.declaration import FigurePath
from holdfast.interface.cli.groups import ArmSourceOptions, ContactOptions
from holdfast.interface.cli.laws import ClosedLoopOptions, LawsOption, read_laws, read_position_sampling, read_targets
from holdfast.interface.cli.options import ArmArgument, JsonOption, StartDegreesOption, TaskOption
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.cli.values import read_configuration, read_failures, read_numbers, read_target
from holdfast.interface.presentation.results import current_command, print_result

if TYPE_CHECKING:
    from holdfast.control.convergence.random_motions import PointToPoint
    from holdfast.model.arm.model import Arm
    from holdfast.model.arm.task import Task

DEFAULT_MOTIONS = 100


def command(
    arm: ArmArgument,
    law: LawsOption = None,
    best: Annotated[bool, "Rank the laws by how often they reach --target after the locks of a convergence map."] = False,
    starts: Annotated[str, "Start positions with --best: a number of random ones, or a lattice such as grid:52."] = "1000",
    configurations: Annotated[int, "Number of motions per position with --best."] = 20,
    over: Annotated[Literal["starts", "targets"], "Positions of the map with --best: starts or targets."] = "starts",
    motions: Annotated[
        int | None,
        typer.Option(
            "--motions", "--tasks", help="Number of random point-to-point motions.", show_default=str(DEFAULT_MOTIONS)
        ),
    ] = None,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the random motions.")] = 0,
    distance: Annotated[str | None, "Shortest and longest distance of random motions in m, for example 0.2,0.8."] = None,
    reachable_after: Annotated[str | None, "Failures, as for --failures, after which random targets stay reachable."] = None,
    start: Annotated[str | None, "Start configuration in rad and m of one motion, simulated instead of random motions."] = None,
    target: Annotated[str | None, "Target, as in 'holdfast simulate'; with --best also grid:12 or random:200."] = None,
    failures: Annotated[
        str, "Joints that lock at the start, one per run: single (each), 'joint2; joint3', or none."
    ] = "single",
    task: TaskOption = None,
    loop: ClosedLoopOptions = ClosedLoopOptions(),
    touched: ContactOptions = ContactOptions(),
    degrees: StartDegreesOption = False,
    chain: ArmSourceOptions = ArmSourceOptions(),
    out: Annotated[FigurePath, "Folder for report.html and tables (CSV)."] = None,
    json_: JsonOption = False,
) -> None:
    """Compare control laws on the same motions, healthy and with an undetected lock.

    All laws are compared with the first one. To compare arms, tools or tasks by their dexterity after a failure, use
    'holdfast assess A B C'.

    Example: holdfast compare-laws panda --task position --law pseudoinverse --law failure-tolerant:0.5 --motions 200 --out laws

    Example: holdfast compare-laws panda --best --task position --target 0.5,0.2,0.4 --starts 100
    """
    model = chain.resolve_arm(arm)
    laws = read_laws(law, model, task, arm, gain=loop.gain, speed_limit=loop.speed_limit)
    clearance = touched.build_contact_clearance(model)
    if best:
        if target is None:
            raise InputError("--best needs --target; give a position, grid:12 or random:200")
        motion_options = (start, motions, distance, reachable_after)
        if any(option is not None for option in motion_options) or failures != "single" or loop.cycles:
            raise InputError("--best uses the locks of a convergence map; leave out the options of given and random motions")
        map_options: dict[str, Any] = {
            "configurations": configurations,
            "over": over,
            "time_limit": loop.time_limit,
            "seed": seed,
        }
        targets, places = read_targets(laws[0], target), read_position_sampling(starts)
        with ProgressBar(json_, "runs") as progress:
            choice = hf.compare_laws(laws, places, targets, best=True, progress=progress, clearance=clearance, **map_options)
        print_result(choice, json_, [] if out is None else choice.save(out, command=current_command()))
        return
    if start is None and target is None:
        sampled_motions = _sample_motions(
            model, laws[0].task, DEFAULT_MOTIONS if motions is None else motions, seed, distance, reachable_after
        )
        q0, targets, description = sampled_motions.q0, sampled_motions.target, f"{sampled_motions.describe()}; seed {seed}"
    elif start is None or target is None:
        raise InputError("--start and --target go together; give both, or neither for random motions")
    elif motions is not None or distance is not None or reachable_after:
        raise InputError("--motions, --distance and --reachable-after apply to random motions; leave out --start and --target")
    else:
        q0, targets = read_configuration(model, start, degrees, "--start"), read_target(model, laws[0].task, target)
        description = f"one motion of '{model.name}'"
    failure_spec = None if failures == "none" else read_failures(model, failures)
    common_options: dict[str, Any] = {
        "cycles": loop.cycles,
        "time_limit": loop.time_limit,
        "seed": seed,
        "about": description,
        "clearance": clearance,
    }
    result = hf.compare_laws(laws, q0, targets, failures=failure_spec, **common_options)
    print_result(result, json_, [] if out is None else result.save(out, command=current_command()))


def _sample_motions(
    arm: Arm, task: Task, motions: int, seed: int, distance: str | None, reachable_after: str | None
) -> PointToPoint:
    distance_range: tuple[float, float] | None = None
    if distance is not None:
        distance_limits = read_numbers("--distance", distance, "least,greatest")
        if distance_limits.size != 2:
            raise InputError(f"--distance has {format_count(distance_limits.size, 'number')}; give shortest,longest in m")
        distance_range = float(distance_limits[0]), float(distance_limits[1])
    failures = None if reachable_after is None else read_failures(arm, reachable_after)
    return hf.point_to_point(arm, motions, seed, distance=distance_range, failures=failures, task=task)
