"""``holdfast design``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import holdfast as hf
from holdfast.cli.groups import Chain
from holdfast.cli.options import TASK_HELP, ArmArgument, FailuresOption, JsonOption, LengthOption, SeedOption
from holdfast.cli.progress import progress_bar
from holdfast.cli.start.assess import read_region
from holdfast.cli.values import read_failures, read_task
from holdfast.errors import InputError
from holdfast.present.results import printed, said
from holdfast.registry import LAWS

if TYPE_CHECKING:
    from holdfast.result import Result


def command(
    arm: ArmArgument,
    vary: Annotated[
        list[str],
        "What to vary, and its bounds: a3=0.2..0.6 (m), alpha4=-90..90deg; a, alpha, d, theta of a row of the arm's "
        "standard DH table, lower and upper limit of a joint, tool.x, .y, .z, .roll, .pitch, .yaw. May be given again.",
    ],
    maximise: Annotated[
        str,
        "What to maximise: an index, of which a quantile over the region counts; convergence, how often the "
        "arm reaches its target after a lock that its controller does not know of; self-motion-size, how far all joints "
        "turn on one self-motion; or tolerant-workspace, the area that a planar arm keeps whatever joint locks.",
    ] = "relative-manipulability",
    law: Annotated[str | None, f"With --maximise convergence: {LAWS.usage}. Default: pseudoinverse."] = None,
    keep_reach: Annotated[bool, "With --maximise convergence or tolerant-workspace: link lengths keep their sum."] = False,
    region: Annotated[Path | None, "Region file (YAML). Default: around the arm's home."] = None,
    task: Annotated[str | None, TASK_HELP] = None,
    failures: FailuresOption = "single",
    length: LengthOption = 1.0,
    level: Annotated[float, "Fraction of the poses that must keep the index; 0.95 maximises the 5 % quantile."] = 0.95,
    poses: Annotated[int, "Poses on which designs are compared."] = 256,
    designs: Annotated[int, "How many designs, spread over the bounds, are tried first."] = 512,
    climbs: Annotated[int, "Climbs with exact gradients, from the best of them."] = 8,
    fresh: Annotated[int, "Fresh poses for the final check."] = 2000,
    seed: SeedOption = 0,
    out: Annotated[Path | None, "Folder for report, best arm and designs; a stopped search resumes."] = None,
    threads: Annotated[int | None, "Threads. Default: all processors."] = None,
    chain: Chain = Chain(),
    json_: JsonOption = False,
) -> None:
    """Optimise link lengths, twists, limits or the tool of an arm for fault tolerance.

    The search maximises a lower quantile: the index that, for example, 95 % of the poses of the region keep after the worst
    single lock, estimated from a sample. The report shows the change of reach and contains the best arm as a file for
    'holdfast assess'.

    Example: holdfast design pa10-9dof --vary a8=-0.2..0.2 --vary alpha8=45..135deg --vary tool.z=0..0.3 --out tool
    """
    if threads is not None:
        hf.kernels.set_threads(threads)
    given = chain.arm(arm)
    space = hf.designs.design_space(given, vary)
    rows = read_task(task, arm, given)
    found: Result
    with progress_bar(json_, "designs") as progress:
        common: dict[str, Any] = {"designs": designs, "climbs": climbs, "seed": seed, "store": out, "progress": progress}
        if maximise == "convergence":
            chosen = LAWS.make(law or "pseudoinverse", given, option="--law", task=rows)
            found = hf.design_for_convergence(chosen, space, keep_reach=keep_reach, **common)
        elif maximise == "tolerant-workspace" and law is None:
            found = hf.designs.design_for_workspace(given, space, keep_reach=keep_reach, seed=seed)
        elif maximise == "self-motion-size" and law is None and not keep_reach:
            found = hf.designs.design_for_self_motion(given, space, task=rows, seed=seed)
        elif law is not None or keep_reach:
            raise InputError(
                "--law belongs to --maximise convergence, --keep-reach to that and to tolerant-workspace; leave them out"
            )
        else:
            common |= {"level": level, "failures": read_failures(given, failures), "length": length}
            place = read_region(region, arm, given)
            found = hf.design(given, space, maximise, region=place, task=rows, poses=poses, fresh=fresh, **common)
    again = {"command": said()} if isinstance(found, hf.designs.EvolvedDesign) else {}  # others make theirs of what they store
    printed(found, json_, [] if out is None else found.save(out, **again), listed=True)
