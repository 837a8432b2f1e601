"""``holdfast design``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.core.registry import LAW_REGISTRY
from holdfast.interface.cli.declaration import FigurePath
from holdfast.interface.cli.groups import ArmSourceOptions, TaskOptions
from holdfast.interface.cli.options import ArmArgument, JsonOption, RegionOption, SeedOption, ThreadsOption
from holdfast.interface.cli.progress import ProgressBar
from holdfast.interface.cli.start.assess import read_region
from holdfast.interface.cli.values import read_failures, read_task
from holdfast.interface.presentation.results import print_result

if TYPE_CHECKING:
    from holdfast.core.result import Result


def command(
    arm: ArmArgument,
    vary: Annotated[
        list[str],
        "Parameter with its bounds, such as a3=0.2..0.6 (m) or alpha4=-90..90deg: a, alpha, d, theta of a row of the arm's "
        "standard DH table, lower or upper limit of a joint, or tool.x, .y, .z, .roll, .pitch, .yaw. Repeatable.",
    ],
    maximise: Annotated[
        str,
        "Objective to maximise: an index, evaluated by its quantile over the region; or convergence, which is how often the "
        "arm reaches its target after an undetected lock.",
    ] = "relative-manipulability",
    law: Annotated[str | None, f"Control law for --maximise convergence: {LAW_REGISTRY.usage}. Default: pseudoinverse."] = None,
    keep_reach: Annotated[bool, "Keep the sum of the varied link lengths constant (with --maximise convergence)."] = False,
    region: RegionOption = None,
    considered: TaskOptions = TaskOptions(),
    level: Annotated[float, "Fraction of the poses that must keep the index; 0.95 maximises the 5 % quantile."] = 0.95,
    poses: Annotated[int, "Number of poses on which designs are compared."] = 256,
    designs: Annotated[int, "Number of designs, spread over the bounds, that are evaluated first."] = 512,
    local_searches: Annotated[int, "Number of local searches from the best of these designs."] = 8,
    check_poses: Annotated[int, "Number of held-out poses for the final evaluation."] = 2000,
    seed: SeedOption = 0,
    out: Annotated[FigurePath, "Folder for report, best arm and designs; the same command resumes a stopped search."] = None,
    threads: ThreadsOption = None,
    chain: ArmSourceOptions = ArmSourceOptions(),
    json_: JsonOption = False,
) -> None:
    """Optimise link lengths, twists, limits or the tool of an arm for fault tolerance.

    The search maximises a lower quantile, for example the index that 95 % of the poses of the region keep after the worst
    single lock, estimated from a sample. The report shows the change of reach, and contains the best arm as a file for
    'holdfast assess'.

    Example: holdfast design pa10-9dof --vary a8=-0.2..0.2 --vary alpha8=45..135deg --vary tool.z=0..0.3 --out tool
    """
    if threads is not None:
        hf.kernels.set_threads(threads)
    baseline = chain.resolve_arm(arm)
    space = hf.designs.design_space(baseline, vary)
    design_task = read_task(considered.task, arm, baseline)
    design_result: Result
    with ProgressBar(json_, "designs") as progress:
        common: dict[str, Any] = {
            "designs": designs,
            "local_searches": local_searches,
            "seed": seed,
            "store": out,
            "progress": progress,
        }
        if maximise == "convergence":
            control_law = LAW_REGISTRY.make(law or "pseudoinverse", baseline, option="--law", task=design_task)
            design_result = hf.design_for_convergence(control_law, space, keep_reach=keep_reach, **common)
        elif law is not None or keep_reach:
            raise InputError("--law and --keep-reach need --maximise convergence; add it, or leave them out")
        else:
            common |= {"level": level, "failures": read_failures(baseline, considered.failures), "length": considered.length}
            workspace_region = read_region(region, arm, baseline)
            design_result = hf.design(
                baseline,
                space,
                maximise,
                region=workspace_region,
                task=design_task,
                poses=poses,
                check_poses=check_poses,
                **common,
            )
    print_result(design_result, json_, [] if out is None else design_result.save(out), listed=True)
