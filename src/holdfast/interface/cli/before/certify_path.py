"""``holdfast certify path``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import holdfast as hf
from holdfast.core.errors import InputError
from holdfast.interface.cli.certify_options import CertificateOutput, SearchOptions
from holdfast.interface.cli.certify_search import prove_claim
from holdfast.interface.cli.groups import ArmSourceOptions
from holdfast.interface.cli.options import ArmArgument, FailuresOption
from holdfast.interface.cli.values import read_numbers
from holdfast.model.failure_modes.sets import read_failures


def path(
    arm: ArmArgument,
    motion: Annotated[Path, typer.Argument(metavar="MOTION", help="CSV file with a column for each joint.")],
    failures: FailuresOption = "single",
    during: Annotated[str, "When a joint may lock: two parts of the motion."] = "0 1",
    tube: Annotated[str, "How far off the path may be, m, and rad where the tool turns; or one number for both."] = "0",
    task: Annotated[str, "What follows the path: pose, position, pointing, planar or planar-pose."] = "pose",
    segments: Annotated[int | None, "Use so many of the motion. Default: all."] = None,
    halvings: Annotated[int, "Of intervals of lock instants, at most."] = 6,
    search: SearchOptions = SearchOptions(),
    chain: ArmSourceOptions = ArmSourceOptions(),
    written: CertificateOutput = CertificateOutput(Path("path.certificate")),
) -> None:
    """Prove that a tool path can be completed after any single lock at any time.

    The motion is a table of the healthy arm's configurations, such as follow writes; between them joints move along straight
    lines. The exit code is 0 if all is proved, 3 if something is undecided, 4 if something is refuted, 1 if the check rejects
    something. Ctrl-C writes what is found so far; with --store the same command resumes.

    Example: holdfast certify path planar-3r motion.csv --task planar --tube 0.0005
    """
    from holdfast.kinematics.paths.joint_table import joint_columns, read_joint_table

    model, failure_times = chain.resolve_arm(arm), read_numbers("--during", during, "two numbers from 0 to 1").tolist()
    if len(failure_times) != 2:
        raise InputError("--during takes two parts of the motion, for example --during '0 0.5'")
    claim = hf.certificates.path_claim(
        model,
        read_joint_table(model, motion, "motion", "time_s").select_columns(joint_columns(model)),
        failures=read_failures(model, failures),
        during=tuple(failure_times),
        tube=read_numbers("--tube", tube, "one number or two, m and rad,"),
        task=task,
        segments=segments,
    )
    prove_claim(claim, search, written, halvings=halvings)
